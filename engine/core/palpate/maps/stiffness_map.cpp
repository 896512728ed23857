// Depth of bone -> stiffness that fades exponentially; dysfunctions multiply, with a smoothstep at their edge.
//
// Based on: Ji, dissertation 2008, section 2.2 for a stiffness a vertex; the depth law and the edge are our own.
#include "palpate/maps/stiffness_map.h"

#include <algorithm>
#include <cmath>

#include "palpate/base/elementary.h"
#include "palpate/base/error.h"

namespace palpate::maps {

namespace {

double smoothstep(double t) { return t * t * (3.0 - 2.0 * t); }

bool isFinite(const Dysfunction& d) {
  return std::isfinite(d.x_mm + d.y_mm + d.radius_mm + d.change_percent + d.edge_softness);
}

/// 1 in the core, 0 from the radius on.
double shareOfChange(const Dysfunction& dysfunction, double distance_mm) {
  if (distance_mm >= dysfunction.radius_mm) return 0.0;
  const double fade_mm = std::clamp(dysfunction.edge_softness, 0.0, 1.0) * dysfunction.radius_mm;
  const double inward_mm = dysfunction.radius_mm - distance_mm;
  return inward_mm >= fade_mm ? 1.0 : smoothstep(inward_mm / fade_mm);
}

}  // namespace

double stiffnessAtDepth(double bone_depth_mm, const DepthLaw& law) {
  if (!std::isfinite(bone_depth_mm)) return law.soft_n_per_mm;
  const double share = elementary::exp(-std::max(bone_depth_mm, 0.0) / law.fade_mm);
  return law.soft_n_per_mm + (law.stiff_n_per_mm - law.soft_n_per_mm) * share;
}

std::vector<double> stiffnessFromDepth(std::span<const double> bone_depth_mm, const DepthLaw& law) {
  std::vector<double> stiffness;
  stiffness.reserve(bone_depth_mm.size());
  for (const double depth : bone_depth_mm) stiffness.push_back(stiffnessAtDepth(depth, law));
  return stiffness;
}

double stiffnessFactor(const Dysfunction& dysfunction, const Vec2& place) {
  if (!isFinite(dysfunction)) return 1.0;
  const double distance = (place - Vec2(dysfunction.x_mm, dysfunction.y_mm)).norm();
  return std::max(0.0, 1.0 + dysfunction.change_percent / 100.0 * shareOfChange(dysfunction, distance));
}

void applyDysfunctions(std::span<const Vec3> positions, std::span<const Dysfunction> dysfunctions,
                       std::span<double> stiffness_n_per_mm) {
  if (stiffness_n_per_mm.size() != positions.size()) throw Error("stiffness map: expected one stiffness per vertex");
  for (std::size_t v = 0; v < positions.size(); ++v) {
    for (const Dysfunction& d : dysfunctions) stiffness_n_per_mm[v] *= stiffnessFactor(d, positions[v].head<2>());
  }
}

}  // namespace palpate::maps
