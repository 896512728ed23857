// The stiffness map: how hard the body pushes back at each vertex, N per mm of depth.
//
// Comes from the depth of the bone under the skin (default) or from measured key points (measured_stiffness.h), then
// dysfunctions edit it. The result goes into the contact surface; no map is queried while a finger moves. Based on: Ji,
// dissertation 2008, section 2.2 (a stiffness per vertex, made softer or stiffer to simulate dysfunctions).
#pragma once

#include <span>
#include <string>
#include <vector>

#include "palpate/base/vec.h"

namespace palpate::maps {

/// k(d) = soft + (stiff - soft) exp(-d / fade): stiff where bone is close under the skin, soft where it is deep;
/// monotone and between the two for any depth.
struct DepthLaw {
  double soft_n_per_mm = 0.3;
  double stiff_n_per_mm = 1.2;
  /// With 23 mm the law is near a layered finite element model pressed 10 mm deep by a fingertip
  /// (docs/explanation/maps.md): 15 mm to the bone gives 0.77 (model 0.84), 40 mm gives 0.46 (model 0.42).
  double fade_mm = 23.0;
  friend bool operator==(const DepthLaw&, const DepthLaw&) = default;
};

/// Stiffness for a depth to bone in mm. A negative depth counts as 0; NaN or infinity (no bone below) gives soft.
double stiffnessAtDepth(double bone_depth_mm, const DepthLaw& law = {});
std::vector<double> stiffnessFromDepth(std::span<const double> bone_depth_mm, const DepthLaw& law = {});

/// A place that is stiffer (or softer) than it should be: what a student has to find.
struct Dysfunction {
  double x_mm = 0.0;
  double y_mm = 0.0;
  double radius_mm = 15.0;       ///< outside nothing changes
  double change_percent = 50.0;  ///< at the centre; -100 makes it weightless, never below
  /// Share of the radius over which the change fades out (smoothstep): 0 a hard edge, 1 from the centre on.
  double edge_softness = 0.5;
  std::string at = {};  ///< the centre by name ("T9 right 30 mm"); resolved to x and y with the body's landmarks
  friend bool operator==(const Dysfunction&, const Dysfunction&) = default;
};

/// Factor on the stiffness at a place of the map plane, >= 0; 1 outside, and for a dysfunction that is not finite.
double stiffnessFactor(const Dysfunction& dysfunction, const Vec2& place);

/// Multiplies the factors of all dysfunctions into the stiffness, vertex by vertex. On a closed body they act through
/// and through: the map plane is seen along z. `at` is not looked at.
void applyDysfunctions(std::span<const Vec3> positions, std::span<const Dysfunction> dysfunctions,
                       std::span<double> stiffness_n_per_mm);

}  // namespace palpate::maps
