// Parts of a body -> contact geometry, deformable skin, planes for the SIMD search, blocks in the map plane. The skin
// is built on its own thread: it takes a quarter of the time that the contact geometry takes.
#include "palpate/scene/body.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>

#include "palpate/base/background.h"
#include "palpate/base/error.h"
#include "palpate/contact/narrow_cracks.h"
#include "palpate/contact/nearby_skin.h"
#include "palpate/scene/body_parts.h"
#include "palpate/tree/triangle_tree.h"

namespace palpate::scene {

namespace {

/// The contact surface's share of the time that building a body takes here.
constexpr double kSurfaceShare = 0.8;

template <class Extend>
PlaneBlocks buildPlaneBlocks(std::size_t count, const Extend& extend) {
  PlaneBlocks blocks;
  blocks.boxes.resize((count + PlaneBlocks::kSize - 1) / PlaneBlocks::kSize);
  for (std::size_t i = 0; i < count; ++i) extend(i, blocks.boxes[i / PlaneBlocks::kSize]);
  return blocks;
}

void noteNarrowCracks(const contact::SurfaceGeometry& geometry, std::vector<std::string>& notes) {
  const contact::NarrowCracks cracks = contact::countCracks(geometry);
  if (cracks.count == 0) return;
  notes.push_back(
      fmt::format("cracks narrower than {:.2g} mm: {}, the largest at ({:.1f}, {:.1f}, {:.1f}) mm; a point finger "
                  "crosses them as if the skin were closed",
                  contact::crackWidth(geometry), cracks.count, cracks.at.x(), cracks.at.y(), cracks.at.z()));
}

std::vector<std::uint8_t> markFront(const Body& body) {
  if (!body.closed || body.anatomy.landmarks.empty()) return {};
  const std::vector<Vec3> normals = mesh::vertexNormals(body.skin);
  std::vector<std::uint8_t> front(normals.size());
  for (std::size_t v = 0; v < normals.size(); ++v) front[v] = normals[v].z() < 0 ? 1 : 0;
  return front;
}

}  // namespace

std::vector<float> thicknessOf(const Body& body, double limit_mm) {
  return tree::thicknessUpTo(body.geometry->tree, body.skin.positions, body.geometry->vertex_normals, limit_mm);
}

std::shared_ptr<const Body> builtBody(BodyParts parts, std::optional<double> thickness_limit_mm,
                                      const Progress& progress) {
  report(progress, "building the contact surface", 0.0);
  const auto body = std::make_shared<Body>();
  static_cast<BodyParts&>(*body) = std::move(parts);
  const mesh::TriangleMesh& skin = body->skin;
  // Built in parallel with the surface, which takes four times as long; cancelled if the surface fails.
  std::atomic<bool> given_up{false};
  Background making_deformable([&] {
    body->deformable = deform::buildSkin(skin, [&](std::string_view, double) {
      if (given_up) throw Error("building the skin was cancelled");
    });
  });
  try {
    body->geometry = contact::buildGeometry(skin, body->self_intersecting, [&](std::string_view stage, double done) {
      report(progress, stage, kSurfaceShare * done);
    });
  } catch (...) {
    given_up = true;
    throw;
  }
  report(progress, "building the contact surface", kSurfaceShare);
  if (skin.triangles.size() <= contact::kMaxPlanes) body->planes = contact::planesOf(body->geometry);
  noteNarrowCracks(*body->geometry, body->notes);
  body->box = mesh::boundingBox(skin);
  body->vertex_blocks = buildPlaneBlocks(
      skin.positions.size(), [&](std::size_t v, Eigen::AlignedBox2d& box) { box.extend(skin.positions[v].head<2>()); });
  body->triangle_blocks = buildPlaneBlocks(skin.triangles.size(), [&](std::size_t t, Eigen::AlignedBox2d& box) {
    for (const Index v : skin.triangles[t]) box.extend(skin.positions[v].head<2>());
  });
  body->front = markFront(*body);
  making_deformable.join();
  body->thickness_limit_mm = thickness_limit_mm;
  if (thickness_limit_mm) setThickness(thicknessOf(*body, *thickness_limit_mm), body->deformable);
  return body;
}

}  // namespace palpate::scene
