#include "palpate/body/skin_surface.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "palpate/body/skin_table.h"
#include "palpate/body/stature.h"

namespace palpate::body {

namespace {

BicubicSpline tableSpline() {
  std::vector<double> coefficients;
  coefficients.reserve(static_cast<std::size_t>(kSkinAcross) * kSkinAlong);
  for (int row = 0; row < kSkinAcross; ++row) {
    const auto& stored = kSkinRadius[static_cast<std::size_t>(std::min(row, kSkinAcross - 1 - row))];
    coefficients.insert(coefficients.end(), stored.begin(), stored.end());
  }
  return {kSkinAcross, kSkinAlong, std::move(coefficients)};
}

}  // namespace

SkinPlace placeOfUnit(double u, double v) {
  return {(2 * u - 1) * kSkinHalfAngle, kSkinLow + v * (kSkinHigh - kSkinLow)};
}

Vec2 unitOfPlace(const SkinPlace& place) {
  return {(place.angle / kSkinHalfAngle + 1) / 2, (place.y - kSkinLow) / (kSkinHigh - kSkinLow)};
}

SkinSurface::SkinSurface(double stature_mm) : SkinSurface(stature_mm, {}, {}) {}

SkinSurface::SkinSurface(double stature_mm, BicubicSpline detail, const Asymmetry& asymmetry)
    : scale_(stature_mm / kTableStatureMm), base_(tableSpline()), detail_(std::move(detail)), asymmetry_(asymmetry) {
  asymmetry_.stature_scale = 1;  // the warp is applied before the scaling
}

SplineValue SkinSurface::radius(const SkinPlace& place) const {
  const Vec2 unit = unitOfPlace(place);
  const SplineValue base = base_.at(unit.x(), unit.y());
  const SplineValue detail = detail_.at(unit.x(), unit.y());
  return {base.value + detail.value, (base.du + detail.du) / (2 * kSkinHalfAngle),
          (base.dv + detail.dv) / (kSkinHigh - kSkinLow)};
}

SkinPoint SkinSurface::at(const SkinPlace& place) const {
  const SplineValue r = radius(place);
  const double s = std::sin(place.angle);
  const double c = std::cos(place.angle);
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
    const double reached = radius({middle, y / scale_}).value * std::sin(middle);
    (reached < target ? low : high) = middle;
  }
  return scale_ * (kSkinAxisZ + radius({low, y / scale_}).value * std::cos(low));
}

}  // namespace palpate::body
