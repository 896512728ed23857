// A smooth scalar over the unit square: tensor-product cubic B-spline with clamped uniform knots.
//
// The built-in skin's radius and its detail layers are stored in it. Twice continuously differentiable, so triangle
// meshes of any density drawn from it show no facets of the table.
#pragma once

#include <vector>

namespace palpate::body {

/// A value and its derivatives by u and v.
struct SplineValue {
  double value = 0;
  double du = 0;
  double dv = 0;
};

class BicubicSpline {
 public:
  BicubicSpline() = default;
  /// `coefficients[i * along + j]` belongs to the i-th B-spline in u and the j-th in v; `across`, `along` >= 4.
  BicubicSpline(int across, int along, std::vector<double> coefficients);

  /// u and v are clamped to [0, 1]. An empty spline is 0 everywhere.
  SplineValue at(double u, double v) const;

  int across() const { return across_; }
  int along() const { return along_; }

 private:
  int across_ = 0;
  int along_ = 0;
  std::vector<double> coefficients_;
};

/// Centre of the i-th of `count` B-splines, in [0, 1] (its Greville abscissa): a spline whose coefficients are samples
/// of a function there is a slightly smoothed copy of it, exact for straight lines.
double splineSite(int count, int i);

}  // namespace palpate::body
