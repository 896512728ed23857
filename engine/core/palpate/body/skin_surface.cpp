// Radius = table + detail, both B-splines over (angle, height); position and tangents from it in cylinder coordinates,
// transformed through the warp by its Jacobian, scaled at the end.
//
// The table is fitted by tools/fit_skin.py (provenance in skin_numbers.txt).
#include "palpate/body/skin_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "palpate/base/elementary.h"
#include "palpate/body/skin_table.h"
#include "palpate/body/spine_line.h"

namespace palpate::body {

namespace {

// --- the fitted table ---

BicubicSpline tableSpline() {
  std::vector<double> coefficients;
  coefficients.reserve(static_cast<std::size_t>(kSkinAcross) * kSkinAlong);
  for (int row = 0; row < kSkinAcross; ++row) {
    const std::span<const float> stored = skinRadii(std::min(row, kSkinAcross - 1 - row));
    coefficients.insert(coefficients.end(), stored.begin(), stored.end());
  }
  return {kSkinAcross, kSkinAlong, std::move(coefficients)};
}

// --- asymmetry ---

// Chosen by eye, all in mm of a man of 1750 mm; no source gives them.
constexpr double kSwayZero = -60;        // the midline crosses the middle here ...
constexpr double kSwayHalfWave = 330;    // ... and again this much higher
constexpr double kSwayReach = 175;       // the sway fades out at the cut of the arms, so the outline keeps its width
constexpr double kShoulderSide = 90;     // the drop begins at this x ...
constexpr double kShoulderBlend = 22;    // ... over about four times this length
constexpr double kShoulderHeight = 110;  // it is largest at this y ...
constexpr double kShoulderSpread = 55;   // ... with this standard deviation

/// A value and its derivatives by x and y.
struct Bend {
  double value = 0;
  double dx = 0;
  double dy = 0;
};

Bend sway(double x, double y) {
  if (std::abs(x) >= kSwayReach) return {};
  constexpr double kPi = std::numbers::pi;
  const double phase = kPi * (y - kSwayZero) / kSwayHalfWave;
  const double turn = kPi * x / kSwayReach;
  const double fade = 0.5 * (1 + elementary::cos(turn));
  return {elementary::sin(phase) * fade, -0.5 * elementary::sin(phase) * elementary::sin(turn) * kPi / kSwayReach,
          elementary::cos(phase) * fade * kPi / kSwayHalfWave};
}

Bend shoulderDrop(double x, double y) {
  const double step = elementary::tanh((x - kShoulderSide) / kShoulderBlend);
  const double lift = (y - kShoulderHeight) / kShoulderSpread;
  const double bell = elementary::exp(-0.5 * lift * lift);
  return {0.5 * (1 + step) * bell, 0.5 * (1 - step * step) / kShoulderBlend * bell,
          -0.5 * (1 + step) * bell * lift / kShoulderSpread};
}

}  // namespace

Warped warp(const Asymmetry& asymmetry, const Vec3& point) {
  Warped result{point, Mat3::Identity()};
  if (asymmetry.amount == 0) return result;
  const double scale = asymmetry.stature_scale;
  const Bend side = sway(point.x() / scale, point.y() / scale);
  const Bend drop = shoulderDrop(point.x() / scale, point.y() / scale);
  const double across = asymmetry.amount * asymmetry.sway_mm;
  const double down = -asymmetry.amount * asymmetry.shoulder_drop_mm;
  result.position += scale * Vec3(across * side.value, down * drop.value, 0);
  result.jacobian.topLeftCorner<2, 2>() += Mat2{{across * side.dx, across * side.dy}, {down * drop.dx, down * drop.dy}};
  return result;
}

SkinAngle placeOfUnit(double u, double v) {
  return {(2 * u - 1) * kSkinHalfAngle, kSkinLow + v * (kSkinHigh - kSkinLow)};
}

Vec2 unitOfPlace(const SkinAngle& place) {
  return {(place.angle / kSkinHalfAngle + 1) / 2, (place.y - kSkinLow) / (kSkinHigh - kSkinLow)};
}

SkinSurface::SkinSurface(double stature_mm) : SkinSurface(stature_mm, {}, {}) {}

SkinSurface::SkinSurface(double stature_mm, BicubicSpline detail, const Asymmetry& asymmetry)
    : scale_(stature_mm / kTableStatureMm), base_(tableSpline()), detail_(std::move(detail)), asymmetry_(asymmetry) {
  asymmetry_.stature_scale = 1;  // the warp is applied before the scaling
}

SplineValue SkinSurface::radius(const SkinAngle& place) const {
  const Vec2 unit = unitOfPlace(place);
  const SplineValue base = base_.at(unit.x(), unit.y());
  const SplineValue detail = detail_.at(unit.x(), unit.y());
  return {base.value + detail.value, (base.du + detail.du) / (2 * kSkinHalfAngle),
          (base.dv + detail.dv) / (kSkinHigh - kSkinLow)};
}

SkinPoint SkinSurface::at(const SkinAngle& place) const {
  const SplineValue r = radius(place);
  const double s = elementary::sin(place.angle);
  const double c = elementary::cos(place.angle);
  const Warped warped = warp(asymmetry_, {r.value * s, place.y, kSkinAxisZ + r.value * c});
  const Vec3 around = warped.jacobian * Vec3(r.du * s + r.value * c, 0, r.du * c - r.value * s);
  const Vec3 upward = warped.jacobian * Vec3(r.dv * s, 1, r.dv * c);
  return {scale_ * warped.position, around.cross(upward).normalized()};
}

double SkinSurface::heightOver(double x, double y) const {
  const double target = std::abs(x) / scale_;
  double low = 0;
  double high = kSkinHalfAngle;
  for (int step = 0; step < 50; ++step) {  // x grows with the angle; 50 halvings reach the last bit
    const double middle = (low + high) / 2;
    const double reached = radius({middle, y / scale_}).value * elementary::sin(middle);
    (reached < target ? low : high) = middle;
  }
  return scale_ * (kSkinAxisZ + radius({low, y / scale_}).value * elementary::cos(low));
}

}  // namespace palpate::body
