// A thin plate spline from the plane to the plane.
#pragma once

#include <Eigen/Core>
#include <span>

#include "palpate/base/vec.h"

namespace palpate::measure {

class ThinPlate {
 public:
  /// Needs knots that are not in one line (throws Error). Places are scaled by `unit` inside. `smoothing` is on the
  /// system's diagonal: 0 meets every value.
  ThinPlate(std::span<const Vec2> knots, std::span<const Vec2> values, double unit, double smoothing);

  Vec2 at(const Vec2& place) const;
  /// d value / d place.
  Mat2 slopeAt(const Vec2& place) const;
  /// Centre of the knots.
  const Vec2& centre() const { return centre_; }

 private:
  double unit_ = 1.0;
  Vec2 centre_ = Vec2::Zero();
  Eigen::Matrix<double, 2, Eigen::Dynamic> knots_;    // in units from the centre
  Eigen::Matrix<double, Eigen::Dynamic, 2> weights_;  // weights of knots, 1, x, y
};

}  // namespace palpate::measure
