// Distances to the nearest bone from a ring around each vertex. Over a post of radius R at a depth t the distance from
// s beside it is d = sqrt((t + R)^2 + s^2) - R; solved for R.
#include "palpate/scene/beneath/tissue_beneath.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "palpate/body/bones.h"
#include "palpate/tissue/narrow_bone.h"

namespace palpate::scene {

namespace {

constexpr double kAsideMm = tissue::kFingertipMm;
/// Four directions, each to both sides: what a bone is only tilted by takes itself away.
constexpr double kDiagonal = 0.5 * std::numbers::sqrt2;
constexpr std::array<std::array<double, 2>, 8> kRing = {{{1, 0},
                                                         {-1, 0},
                                                         {0, 1},
                                                         {0, -1},
                                                         {kDiagonal, kDiagonal},
                                                         {-kDiagonal, -kDiagonal},
                                                         {kDiagonal, -kDiagonal},
                                                         {-kDiagonal, kDiagonal}}};

double radiusOf(double depth_mm, double aside_mm) {
  const double farther = aside_mm - depth_mm;
  const double square = kAsideMm * kAsideMm + depth_mm * depth_mm - aside_mm * aside_mm;
  if (!(2.0 * tissue::kFlatBoneMm * farther > square)) return tissue::kFlatBoneMm;
  constexpr double kNarrowest = 1.0;
  return std::max(kNarrowest, square / (2.0 * farther));
}

/// Of the distances from the ring around a place.
double radiusWithin(double depth_mm, std::span<const double> ring_mm) {
  double curvature = 0.0;
  for (std::size_t i = 0; i < ring_mm.size(); i += 2) {
    curvature += 2.0 / radiusOf(depth_mm, 0.5 * (ring_mm[i] + ring_mm[i + 1]));
  }
  return std::min(tissue::kFlatBoneMm, static_cast<double>(ring_mm.size()) / curvature);
}

void addRing(const Vec3& place, const Vec3& normal, std::vector<Vec3>& points) {
  const Vec3 first = normal.unitOrthogonal();
  const Vec3 second = normal.cross(first);
  for (const auto& [a, b] : kRing) points.push_back(place + kAsideMm * (a * first + b * second));
}

}  // namespace

std::vector<double> boneRadii(const mesh::TriangleMesh& skin, std::span<const double> nearest_mm,
                              std::span<const body::Bone> bones) {
  const std::vector<Vec3> normals = mesh::vertexNormals(skin);
  std::vector<Index> asked;
  std::vector<Vec3> points;
  for (Index v = 0; v < skin.positions.size(); ++v) {
    if (!(nearest_mm[v] < tissue::kDeepBoneMm)) continue;
    asked.push_back(v);
    addRing(skin.positions[v], normals[v], points);
  }
  std::vector<double> radii(skin.positions.size(), tissue::kFlatBoneMm);
  if (asked.empty() || bones.empty()) return radii;
  const std::vector<double> aside_mm = body::depthToBones(points, bones).depth_mm;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const std::span<const double> ring(&aside_mm[i * kRing.size()], kRing.size());
    radii[asked[i]] = radiusWithin(nearest_mm[asked[i]], ring);
  }
  return radii;
}

}  // namespace palpate::scene
