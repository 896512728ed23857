// Each form with its derivative by q written out by hand; tests compare them with differences.
//
// Based on: Ji, dissertation 2008, (4.1), (4.2), Figure 4.4 and Table 4.2; two Gaussians and the power tail are our
// fits.
#include "palpate/tissue/profile_forms.h"

#include <numbers>

#include "palpate/base/elementary.h"
#include "palpate/base/gaussian.h"

namespace palpate::tissue {

namespace {

/// sigma of (4.2), where the Gaussian turns from hollow to bulging: 1 / sqrt(2 pi).
constexpr double kInflection = 0.3989422804014327;
/// How steeply the logarithm begins: two decades of it, as in the picture of Table 4.2.
constexpr double kLogarithmReach = 100.0;
constexpr double kFadeStart = 0.8;

}  // namespace

ProfilePoint halfGaussianForm(double q) noexcept {
  const double value = halfGaussian(q);
  return {value, -2.0 * kGaussianRate * q * value};
}

ProfilePoint sharpForm(double q) noexcept {
  constexpr double kSpan = kGaussianCut - kInflection;
  const double x = kInflection + kSpan * q;
  const double value = elementary::exp(-std::numbers::pi * (x * x - kInflection * kInflection));
  return {value, -2.0 * std::numbers::pi * x * kSpan * value};
}

ProfilePoint cosineForm(double q) noexcept {
  const double angle = std::numbers::pi * q;
  return {0.5 * (1.0 + elementary::cos(angle)), -0.5 * std::numbers::pi * elementary::sin(angle)};
}

ProfilePoint logarithmForm(double q) noexcept {
  const double whole = elementary::log1p(kLogarithmReach);
  return {1.0 - elementary::log1p(kLogarithmReach * q) / whole,
          -kLogarithmReach / ((1.0 + kLogarithmReach * q) * whole)};
}

ProfilePoint twoGaussiansForm(const TwoGaussians& shape, double q) noexcept {
  const double w = shape.wide_weight;
  const double narrow = (1.0 - w) * elementary::exp(-q * q / (shape.narrow * shape.narrow));
  const double wide = w * elementary::exp(-q * q / (shape.wide * shape.wide));
  return {narrow + wide, -2.0 * q * (narrow / (shape.narrow * shape.narrow) + wide / (shape.wide * shape.wide))};
}

ProfilePoint powerForm(const PowerTail& shape, double q) noexcept {
  const double base = 1.0 + q * q / (shape.width * shape.width);
  const double value = elementary::pow(base, -shape.exponent);
  const double slope = -2.0 * shape.exponent * q / (shape.width * shape.width) * value / base;
  return fadedOut({value, slope}, q);
}

ProfilePoint fadedOut(const ProfilePoint& point, double q) noexcept {
  if (q <= kFadeStart) return point;
  constexpr double kWidth = 1.0 - kFadeStart;
  const double t = (q - kFadeStart) / kWidth;
  const double window = 1.0 - t * t * (3.0 - 2.0 * t);
  const double window_slope = -6.0 * t * (1.0 - t) / kWidth;
  return {point.value * window, point.slope * window + point.value * window_slope};
}

}  // namespace palpate::tissue
