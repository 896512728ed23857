// A smooth curve through a few points in space: rib centre lines, the scapula's outline, finger axes.
#pragma once

#include <span>
#include <vector>

#include "palpate/base/vec.h"

namespace palpate::body {

/// Interpolating cubic spline over the chord length, twice differentiable; at most a few dozen points (dense solve).
class CubicSpline {
 public:
  enum class Ends { natural, closed };

  explicit CubicSpline(std::span<const Vec3> points, Ends ends = Ends::natural);

  /// Length of the polygon through the points: the range of the parameter.
  double length() const { return knots_.back(); }
  /// Parameter of point i.
  double knot(std::size_t i) const { return knots_[i]; }
  Vec3 at(double s) const;

  /// `count` points evenly spaced by arc length, both ends included (closed: the end is left out).
  std::vector<Vec3> evenly(std::size_t count) const;

 private:
  Ends ends_;
  std::vector<Vec3> points_;   // closed: the first point again at the end
  std::vector<Vec3> second_;   // second derivative at each point
  std::vector<double> knots_;  // chord length up to each point
};

}  // namespace palpate::body
