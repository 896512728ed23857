#include "palpate/body/asymmetry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palpate::body {

namespace {

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
  const double fade = 0.5 * (1 + std::cos(turn));
  return {std::sin(phase) * fade, -0.5 * std::sin(phase) * std::sin(turn) * kPi / kSwayReach,
          std::cos(phase) * fade * kPi / kSwayHalfWave};
}

Bend shoulderDrop(double x, double y) {
  const double step = std::tanh((x - kShoulderSide) / kShoulderBlend);
  const double lift = (y - kShoulderHeight) / kShoulderSpread;
  const double bell = std::exp(-0.5 * lift * lift);
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

}  // namespace palpate::body
