// One curve of layered tissue in the form that the deformation evaluates: a polynomial of a bell, without a root or a
// table.
//
// share(q) = x^2 sum c_k y^k with the bell v = 1 / (1 + bend q^2), x = v moved and scaled to be 1 in the middle and 0
// on the rim q = 1, y = 2 x - 1. So value and slope vanish on the rim whatever the coefficients, and curves with the
// same bend are blended by blending coefficients. Seven terms follow the finite element profiles of layered tissue,
// bulges included, within 0.6 % of the depth (docs/explanation/tissue.md); one division and ten multiplications serve
// eight vertices at once, where a table of them would be gathered lane by lane. Based on: the power tail (1 + q^2)^-p
// of a drag over layered tissue, of which v is the case p = 1.
#pragma once

#include <array>
#include <span>

namespace palpate::tissue {

inline constexpr int kCurveTerms = 7;
/// For a press: the bell is half as high at 0.41 of the region's radius.
inline constexpr double kPressBend = 6.0;
/// For a drag, whose core is narrower and whose tail longer: at 0.35.
inline constexpr double kDragBend = 8.0;

/// Coefficients c_k; value-initialised it is 0 everywhere.
struct LayeredCurve {
  std::array<double, kCurveTerms> terms{};
};

/// A value and its derivative by q^2.
struct CurvePoint {
  double value = 0.0;
  double by_q2 = 0.0;
};

/// At q^2 >= 0; {0, 0} from 1 on and for NaN.
inline CurvePoint curveAt(const LayeredCurve& curve, double bend, double q2) noexcept {
  if (!(q2 < 1.0)) return {};
  const double rim = 1.0 / (1.0 + bend);
  const double scale = 1.0 / (1.0 - rim);
  const double bell = 1.0 / (1.0 + bend * q2);
  const double x = (bell - rim) * scale;
  const double y = 2.0 * x - 1.0;
  double sum = 0.0;
  double slope = 0.0;
  for (int k = kCurveTerms - 1; k >= 0; --k) {
    slope = slope * y + sum;
    sum = sum * y + curve.terms[static_cast<std::size_t>(k)];
  }
  const double by_x = 2.0 * x * (sum + x * slope);
  return {x * x * sum, -bend * bell * bell * scale * by_x};
}

/// a + share (b - a).
inline LayeredCurve blended(const LayeredCurve& a, const LayeredCurve& b, double share) noexcept {
  LayeredCurve curve;
  for (std::size_t k = 0; k < curve.terms.size(); ++k) curve.terms[k] = a.terms[k] + share * (b.terms[k] - a.terms[k]);
  return curve;
}

/// The skin under a press, ready to be evaluated: with q = r / radius the skin goes down by `down`(q) of the depth and
/// away from the axis by q `outward`(q) of it.
struct PressCurves {
  double radius_mm = 0.0;  ///< where nothing moves any more
  LayeredCurve down;       ///< 1 in the middle
  LayeredCurve outward;
};

/// The skin under a drag in tissue that has no direction of its own: half axes of the rim along and across the drag.
struct DragCurve {
  double along_mm = 0.0;
  double across_mm = 0.0;
  LayeredCurve share;    ///< 1 in the middle
  double tenth_q = 0.6;  ///< where a tenth is left: the 2 mm contour of a drag of 20 mm
};

/// A point of a curve that is wanted.
struct CurveSample {
  double q = 0.0;
  double value = 0.0;
  double weight = 1.0;
};

/// Least squares. `of_share`: the curve is 1 in the middle; otherwise it is q times what comes out
/// (PressCurves::outward), whose middle is free. Samples from q = 1 on do not count. Throws Error for fewer samples
/// within than terms.
LayeredCurve fittedShare(std::span<const CurveSample> samples, double bend);
LayeredCurve fittedOutward(std::span<const CurveSample> samples, double bend);

}  // namespace palpate::tissue
