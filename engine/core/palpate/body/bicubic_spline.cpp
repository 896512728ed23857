// The four B-splines of each direction that are not zero at a place, by their recursion; then 16 products.
//
// Based on: de Boor, "A Practical Guide to Splines" (1978), the recursion of Cox and de Boor; Greville's abscissae.
#include "palpate/body/bicubic_spline.h"

#include <algorithm>
#include <array>
#include <utility>

#include "palpate/base/error.h"

namespace palpate::body {

namespace {

constexpr int kDegree = 3;

/// Knot i of the clamped uniform sequence with `spans` spans over [0, 1].
double knot(int spans, int i) { return static_cast<double>(std::clamp(i - kDegree, 0, spans)) / spans; }

/// The four B-splines that are not zero at a place, their derivatives, and the index of the first.
struct LocalBasis {
  int first;
  std::array<double, kDegree + 1> value;
  std::array<double, kDegree + 1> slope;
};

/// Cox - de Boor: raises the degree one at a time; the derivative comes from the degree below the last.
LocalBasis basisAt(int count, double at) {
  const int spans = count - kDegree;
  const double t = std::clamp(at, 0.0, 1.0);
  LocalBasis basis{std::min(static_cast<int>(t * spans), spans - 1), {1, 0, 0, 0}, {}};
  for (int degree = 1; degree <= kDegree; ++degree) {
    double saved = 0;
    double saved_slope = 0;
    for (int r = 0; r < degree; ++r) {
      const int right = basis.first + kDegree + r + 1;
      const double high = knot(spans, right);
      const double low = knot(spans, right - degree);
      const double part = basis.value[r] / (high - low);
      if (degree == kDegree) basis.slope[r] = saved_slope - degree * part;
      saved_slope = degree * part;
      basis.value[r] = saved + (high - t) * part;
      saved = (t - low) * part;
    }
    basis.value[degree] = saved;
    basis.slope[degree] = saved_slope;
  }
  return basis;
}

}  // namespace

BicubicSpline::BicubicSpline(int across, int along, std::vector<double> coefficients)
    : across_(across), along_(along), coefficients_(std::move(coefficients)) {
  if (across <= kDegree || along <= kDegree)
    throw Error("spline: at least 4 coefficients are required in each direction");
  if (coefficients_.size() != static_cast<std::size_t>(across) * along)
    throw Error("spline: wrong number of coefficients");
}

SplineValue BicubicSpline::at(double u, double v) const {
  SplineValue sum;
  if (coefficients_.empty()) return sum;
  const LocalBasis bu = basisAt(across_, u);
  const LocalBasis bv = basisAt(along_, v);
  for (int i = 0; i <= kDegree; ++i) {
    const double* row = coefficients_.data() + static_cast<std::size_t>(bu.first + i) * along_ + bv.first;
    double value = 0;
    double slope = 0;
    for (int j = 0; j <= kDegree; ++j) {
      value += bv.value[j] * row[j];
      slope += bv.slope[j] * row[j];
    }
    sum.value += bu.value[i] * value;
    sum.du += bu.slope[i] * value;
    sum.dv += bu.value[i] * slope;
  }
  return sum;
}

double splineSite(int count, int i) {
  const int spans = count - kDegree;
  return (knot(spans, i + 1) + knot(spans, i + 2) + knot(spans, i + 3)) / kDegree;
}

}  // namespace palpate::body
