// The location ratio as printed in (4.13), which is not that of an ellipse.
//
// It takes the eccentric angle for the polar one, so that q = 1 is the pedal curve r^2 = a^2 cos^2 + b^2 sin^2: it
// touches the ellipse on its axes and reaches beyond it everywhere else, by up to (T + 1/T)/2 (7 % for the measured
// ratios), and is dented for T > sqrt(2). Based on: Ji, dissertation 2008, (4.10) to (4.14); E14.
#pragma once

#include <cmath>

#include "palpate/base/vec.h"

namespace palpate::deform {

/// A location ratio and how it grows per mm along the two axes of the region.
struct Location {
  double q = 0.0;
  Vec2 slope = Vec2::Zero();
};

/// (4.13) for an offset (u, v) in mm along and across the axis of length `half_axis`; `t` is b/a. 0 at the centre,
/// where the printed form is 0/0.
inline Location pedalLocation(double half_axis, double t, const Vec2& offset) noexcept {
  const double distance2 = offset.squaredNorm();
  if (!(distance2 > 0.0)) return {};
  const Vec2 stretched(offset.x(), t * t * offset.y());
  const double root = std::sqrt(offset.dot(stretched));
  const double q = distance2 / (half_axis * root);
  return {q, 2.0 * offset / (half_axis * root) - q / (root * root) * stretched};
}

}  // namespace palpate::deform
