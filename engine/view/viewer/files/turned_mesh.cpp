#include "view/viewer/files/turned_mesh.h"

#include <utility>

#include "palpate/mesh/files/load.h"
#include "palpate/mesh/files/save.h"
#include "palpate/mesh/open_parts.h"
#include "palpate/mesh/topology.h"
#include "palpate/scene/body_parts.h"

namespace palpate::viewer {

namespace {

/// Length: twice the triangle's area.
Vec3 areaVector(const mesh::TriangleMesh& skin, const Triangle& triangle) {
  return mesh::areaVector2(skin.positions[triangle[0]], skin.positions[triangle[1]], skin.positions[triangle[2]]);
}

}  // namespace

mesh::TurnOver doubtfulSides(const mesh::TriangleMesh& skin, const Vec3& to_eye) {
  // The share of a surface that is turned away from the eye, less what is turned to it: the outside of a bowl or a
  // tube has both, a sheet seen from its back is near 1.
  constexpr double kBackSeen = 0.35;
  const mesh::OpenParts open = findOpenParts(skin, edgeUses(skin));
  if (!open.doubtful.empty()) return mesh::TurnOver::doubtful;
  if (open.as_given.empty()) return mesh::TurnOver::none;
  double area = 0.0, to_us = 0.0;
  for (const Triangle& triangle : skin.triangles) area += areaVector(skin, triangle).norm();
  for (const auto& part : open.as_given) {
    for (const Index t : part) to_us += areaVector(skin, skin.triangles[t]).dot(to_eye);
  }
  return to_us < -kBackSeen * area ? mesh::TurnOver::open : mesh::TurnOver::none;
}

std::filesystem::path writeTurned(const scene::BodySettings& body, mesh::TurnOver turn_over,
                                  const std::filesystem::path& folder) {
  mesh::MeshWithChannels loaded = mesh::loadWithChannels(body.file, scene::loadOptionsOf(body));
  const mesh::RepairResult turned =
      mesh::repair(std::move(loaded.mesh), {.turn_over = turn_over, .find_self_intersections = false});
  std::filesystem::path file = folder / body.file.stem();
  file += "_turned.ply";
  mesh::save(file, turned.mesh, mesh::followed(loaded.channels, turned.source_vertex));
  return file;
}

}  // namespace palpate::viewer
