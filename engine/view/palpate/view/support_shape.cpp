// Rings round the slab, from the middle of its top over the edge to the middle of its underside; each is the outline
// moved inwards, so that all have the same number of points. The body's shade: its skin, gathered in patches, covers as
// discs the sky of each point of the top.
//
// Based on: Bunnell, "Dynamic ambient occlusion and indirect lighting", GPU Gems 2, 2005, as skin_shade.cpp.
#include "palpate/view/support_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "palpate/tree/triangle_tree.h"

namespace palpate::view {

namespace {

/// The top is this far outside the body, which is flat where it lies on it: two surfaces in one place would flicker.
constexpr double kTopOutsideMm = 0.3;

constexpr double kTableWidthMm = 700.0;
constexpr double kBesideBodyMm = 40.0;  ///< around a body that is broader than the table
constexpr double kTableBeyondMm = 140.0;
constexpr double kSeatMm = 480.0;

Eigen::AlignedBox3d boxAlong(const Mat3& axes, const mesh::TriangleMesh& skin) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : skin.positions) box.extend(Vec3(axes.transpose() * p));
  return box;
}

// ---- rings

constexpr int kCornerSteps = 8;
constexpr double kStepMm = 10.0;  ///< step of the shade around the body, which falls off over kFallsOffMm

/// A point of the outline: the corner of the inner rectangle that it belongs to, or a place between two of them.
struct OutlinePoint {
  Vec2 share;   ///< share of the inner rectangle's half extents, -1 to 1
  Vec2 normal;  ///< unit, outward
};

/// Counter-clockwise, seen from the body.
std::vector<OutlinePoint> slabOutline(const SupportSlab& slab) {
  std::vector<OutlinePoint> outline;
  const std::array<Vec2, 4> corners = {{{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};
  for (std::size_t side = 0; side < 4; ++side) {
    const Vec2& corner = corners[side];
    const double from = 0.5 * std::numbers::pi * static_cast<double>(side);
    for (int step = 0; step <= kCornerSteps; ++step) {
      const double angle = from + 0.5 * std::numbers::pi * step / kCornerSteps;
      outline.push_back({corner, {std::cos(angle), std::sin(angle)}});
    }
    const Vec2& next = corners[(side + 1) % 4];
    const double length = 2.0 * slab.half[side % 2 == 0 ? 0 : 1];
    const int steps = std::max(1, static_cast<int>(length / kStepMm));
    for (int step = 1; step < steps; ++step) {
      const double share = static_cast<double>(step) / steps;
      outline.push_back({(1.0 - share) * corner + share * next, outline.back().normal});
    }
  }
  return outline;
}

/// A ring: how far in from the outline, how far below the top, and how its normal leans: 0 outward, 1 up, -1 down.
struct SlabRing {
  double in_mm;
  double below_mm;
  double up;
};

std::vector<SlabRing> makeSlabRings(const SupportSlab& slab) {
  std::vector<SlabRing> rings;
  const double middle = slab.half.minCoeff();
  const double edge = slab.edge_mm;
  const int flat = std::max(1, static_cast<int>((middle - edge) / kStepMm));
  for (int i = 0; i < flat; ++i) rings.push_back({middle + (edge - middle) * i / flat, 0.0, 1.0});
  constexpr int kArc = 7;
  for (int i = 0; i <= kArc; ++i) {
    const double angle = 0.5 * std::numbers::pi * i / kArc;
    rings.push_back({edge * (1.0 - std::sin(angle)), edge * (1.0 - std::cos(angle)), std::cos(angle)});
  }
  for (int i = kArc; i >= 0; --i) {
    const double angle = 0.5 * std::numbers::pi * i / kArc;
    rings.push_back(
        {edge * (1.0 - std::sin(angle)), slab.thickness_mm - edge * (1.0 - std::cos(angle)), -std::cos(angle)});
  }
  rings.push_back({middle, slab.thickness_mm, -1.0});
  return rings;
}

SupportVertex makeVertex(const SupportSlab& slab, const SlabRing& ring, const OutlinePoint& point) {
  const double corner = std::max(slab.corner_mm - ring.in_mm, 0.0);
  const Vec2 inner = (slab.half - Vec2::Constant(ring.in_mm + corner)).cwiseMax(0.0);
  const Vec2 at = inner.cwiseProduct(point.share) + corner * point.normal;
  const auto out = [&](const Vec2& plan) { return Vec3(plan.x() * slab.across() + plan.y() * slab.along); };
  const double level = std::sqrt(std::max(0.0, 1.0 - ring.up * ring.up));
  const Vec3 place = slab.middle + out(at) - ring.below_mm * slab.up;
  const Vec3 normal = level * out(point.normal) + ring.up * slab.up;
  return {place.cast<float>(), normal.cast<float>(), 1.0f};
}

// ---- the shade of the body

struct ShadePatch {
  Vec3f place = Vec3f::Zero();  // first a sum by area
  Vec3f normal = Vec3f::Zero();
  float area = 0.0f;
};

/// Patches of the skin that faces the slab: other skin covers nothing of its sky.
std::vector<ShadePatch> shadePatches(const mesh::TriangleMesh& skin, const Vec3& up) {
  constexpr double kCellMm = 22.0;
  std::map<std::array<int, 3>, ShadePatch> cells;
  for (const Triangle& t : skin.triangles) {
    const Vec3& a = skin.positions[t[0]];
    const Vec3 twice = (skin.positions[t[1]] - a).cross(skin.positions[t[2]] - a);
    if (!(twice.dot(up) < 0.0)) continue;
    const Vec3 middle = (a + skin.positions[t[1]] + skin.positions[t[2]]) / 3.0;
    const Eigen::Vector3i cell = (middle / kCellMm).array().floor().cast<int>();
    const auto area = static_cast<float>(0.5 * twice.norm());
    ShadePatch& patch = cells[{cell.x(), cell.y(), cell.z()}];
    patch.place += area * middle.cast<float>();
    patch.normal += twice.cast<float>();
    patch.area += area;
  }
  std::vector<ShadePatch> patches;
  for (auto& [cell, patch] : cells) {
    patch.place /= patch.area;
    patch.normal.normalize();
    patches.push_back(patch);
  }
  return patches;
}

float skyOver(const SupportVertex& vertex, const std::vector<ShadePatch>& patches) {
  float covered = 0.0f;
  for (const ShadePatch& patch : patches) {
    const Vec3f way = patch.place - vertex.place;
    const float rises = way.dot(vertex.normal);
    const float faces = -way.dot(patch.normal);
    if (rises <= 0.0f || faces <= 0.0f) continue;
    const float squared = way.squaredNorm();
    covered += rises * faces * patch.area / (squared * (std::numbers::pi_v<float> * squared + patch.area));
  }
  return std::max(0.0f, 1.0f - covered);
}

/// Patches are too coarse for the gap around the contact: there it is darker the nearer the skin is.
float nearSkin(const SupportVertex& vertex, const tree::TriangleTree& tree) {
  constexpr double kReachMm = 50.0;
  constexpr double kDark = 0.75;
  constexpr double kFallsOffMm = 16.0;
  const auto nearest = tree::nearestPoint(tree, vertex.place.cast<double>(), kReachMm);
  if (nearest.triangle == kNoIndex) return 1.0f;
  return static_cast<float>(1.0 - kDark * std::exp(-std::sqrt(nearest.closest.squared_distance) / kFallsOffMm));
}

}  // namespace

Eigen::AlignedBox3d SupportSlab::box() const {
  Eigen::AlignedBox3d box;
  for (const double x : {-half.x(), half.x()}) {
    for (const double y : {-half.y(), half.y()}) {
      for (const double below : {0.0, thickness_mm}) {
        box.extend(Vec3(middle + x * across() + y * along - below * up));
      }
    }
  }
  return box;
}

std::optional<SupportSlab> supportSlab(const scene::World& world) {
  const auto& support = world.body->anatomy.support;
  if (!support || world.body->skin.positions.empty()) return std::nullopt;
  SupportSlab slab;
  slab.up = support->normal;
  const bool sits = std::abs(slab.up.y()) > std::numbers::sqrt2 / 2;  // cranial is up
  const Vec3 axis = sits ? Vec3::UnitZ() : Vec3::UnitY();
  slab.along = (axis - axis.dot(slab.up) * slab.up).normalized();
  Mat3 axes;
  axes << slab.across(), slab.along, slab.up;
  const Eigen::AlignedBox3d body = boxAlong(axes, world.body->skin);
  Vec3 middle = body.center();
  middle.z() = support->point.dot(slab.up) - kTopOutsideMm;
  slab.middle = axes * middle;
  const Vec3 half = 0.5 * body.sizes();
  if (sits) {
    slab.half = Vec2::Constant(0.5 * kSeatMm).cwiseMax(half.head<2>());
    slab.corner_mm = 0.6 * slab.half.minCoeff();
    slab.edge_mm = 24.0;
    slab.thickness_mm = 70.0;
  } else {
    slab.half = {std::max(0.5 * kTableWidthMm, half.x() + kBesideBodyMm), half.y() + kTableBeyondMm};
    slab.corner_mm = 55.0;
    slab.edge_mm = 22.0;
    slab.thickness_mm = 65.0;
  }
  return slab;
}

SupportShape supportShape(const SupportSlab& slab, const scene::World& world) {
  SupportShape shape;
  const std::vector<OutlinePoint> outline = slabOutline(slab);
  const std::vector<SlabRing> rings = makeSlabRings(slab);
  const std::vector<ShadePatch> patches = shadePatches(world.body->skin, slab.up);
  const auto round = static_cast<Index>(outline.size());
  for (const SlabRing& ring : rings) {
    for (const OutlinePoint& point : outline) {
      shape.vertices.push_back(makeVertex(slab, ring, point));
      SupportVertex& vertex = shape.vertices.back();
      if (ring.up > 0.0) vertex.sky = skyOver(vertex, patches) * nearSkin(vertex, world.surface.geometry->tree);
    }
  }
  for (Index ring = 0; ring + 1 < rings.size(); ++ring) {
    for (Index i = 0; i < round; ++i) {
      const Index next = (i + 1) % round;
      const Index inner = ring * round;
      const Index outer = inner + round;
      shape.triangles.push_back({inner + i, outer + i, outer + next});
      shape.triangles.push_back({inner + i, outer + next, inner + next});
    }
  }
  return shape;
}

}  // namespace palpate::view
