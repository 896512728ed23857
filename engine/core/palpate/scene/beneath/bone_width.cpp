// Distances to the nearest bone from a ring around each vertex. Over a post of radius R at a depth t the distance from
// s beside it is d = sqrt((t + R)^2 + s^2) - R; solved for R.
//
// The ring lies where the load ends: as wide as a fingertip, and wider by the depth, as a load spreads by 45 degrees on
// its way down. So a post with a flat top counts as the round one that pushes back as hard.
#include "palpate/scene/beneath/bone_width.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "palpate/body/bones.h"
#include "palpate/tissue/narrow_bone.h"

namespace palpate::scene {

namespace {

/// Two directions, whose mean curvature is that of all, each to both sides: what a bone is only tilted by takes itself
/// away.
constexpr std::array<std::array<double, 2>, 4> kRing = {{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

/// Where it can, at right angles to the body's height: spinous processes are blades along it.
Vec3 sidewaysDirection(const Vec3& normal) {
  constexpr double kNearlyUpright = 0.9;
  return normal.cross(std::abs(normal.y()) < kNearlyUpright ? Vec3::UnitY() : Vec3::UnitX()).normalized();
}

double ringRadius(double depth_mm) { return tissue::kFingertipMm + depth_mm; }

double radiusOf(double depth_mm, double aside_mm) {
  const double ring_mm = ringRadius(depth_mm);
  const double farther = aside_mm - depth_mm;
  const double square = ring_mm * ring_mm + depth_mm * depth_mm - aside_mm * aside_mm;
  if (!(2.0 * tissue::kFlatBoneMm * farther > square)) return tissue::kFlatBoneMm;
  constexpr double kNarrowest = 1.0;
  return std::max(kNarrowest, square / (2.0 * farther));
}

/// The bone's radius, from its distances to the ring around a place.
double radiusWithin(double depth_mm, const std::array<double, kRing.size()>& ring_mm) {
  double curvature = 0.0;
  for (std::size_t i = 0; i < ring_mm.size(); i += 2) {
    curvature += 2.0 / radiusOf(depth_mm, 0.5 * (ring_mm[i] + ring_mm[i + 1]));
  }
  return std::min(tissue::kFlatBoneMm, static_cast<double>(ring_mm.size()) / curvature);
}

}  // namespace

std::vector<float> boneRadii(const mesh::TriangleMesh& skin, std::span<const double> nearest_mm,
                             std::span<const body::Bone> bones) {
  const std::vector<Vec3> normals = mesh::vertexNormals(skin);
  std::vector<Index> asked;
  for (Index v = 0; v < skin.positions.size(); ++v) {
    if (nearest_mm[v] < tissue::kDeepBoneMm) asked.push_back(v);
  }
  std::vector<float> radii(skin.positions.size(), static_cast<float>(tissue::kFlatBoneMm));
  if (asked.empty() || bones.empty()) return radii;
  // One direction after the other: each search begins with the answer of the point before.
  std::vector<Vec3> points;
  points.reserve(asked.size() * kRing.size());
  for (const auto& [a, b] : kRing) {
    for (const Index v : asked) {
      const Vec3 first = sidewaysDirection(normals[v]);
      const Vec3 second = normals[v].cross(first);
      points.emplace_back(skin.positions[v] + ringRadius(nearest_mm[v]) * (a * first + b * second));
    }
  }
  const std::vector<double> aside_mm = body::depthToBones(points, bones).depth_mm;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    std::array<double, kRing.size()> ring_mm{};
    for (std::size_t k = 0; k < kRing.size(); ++k) ring_mm[k] = aside_mm[k * asked.size() + i];
    radii[asked[i]] = static_cast<float>(radiusWithin(nearest_mm[asked[i]], ring_mm));
  }
  return radii;
}

}  // namespace palpate::scene
