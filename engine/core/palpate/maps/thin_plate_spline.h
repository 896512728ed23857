// Thin-plate spline: the surface through scattered values that bends least.
//
// f(x) = affine part + sum w_i r_i^2 ln r_i over the places; exact at every value, and almost straight beyond the
// outermost places. Serves the stiffness map next to GRI (measured_stiffness.h).
// Based on: Duchon, "Splines minimizing rotation-invariant semi-norms in Sobolev spaces", 1977; Bookstein, "Principal
// warps: thin-plate splines and the decomposition of deformations", 1989.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/maps/plane_scaling.h"

namespace palpate::maps {

/// More make a dense system that takes seconds and hundreds of MB.
inline constexpr std::size_t kMaxThinPlatePlaces = 2000;

class ThinPlateSpline {
 public:
  /// One value a place; places that coincide (within a micrometre) are one place with the mean of their values.
  /// Throws Error for fewer than three places, places on one line, more than 2000, numbers that are not finite, lists
  /// of different lengths. O(n^3).
  ThinPlateSpline(std::span<const Vec2> places_mm, std::span<const double> values);

  /// O(n), no allocation.
  double at(const Vec2& place_mm) const noexcept;

 private:
  PlaneScaling scaling_;
  std::vector<Vec2> places_;  // scaled
  std::vector<double> weights_;
  Vec3 affine_;  // constant, x, y
};

}  // namespace palpate::maps
