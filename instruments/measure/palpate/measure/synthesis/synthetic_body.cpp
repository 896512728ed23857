#include "palpate/measure/synthesis/synthetic_body.h"

#include <algorithm>
#include <cmath>

namespace palpate::measure {

namespace {

// The table of the chart reaches beyond the back: dragged skin needs places there too.
constexpr double kRowStep = 2.0;
constexpr double kColumnStep = 1.0;
constexpr int kHalfRows = 120;
constexpr int kHalfColumns = 220;
constexpr int kColumns = 2 * kHalfColumns + 1;

double bump(double x, double y, double wide, double high) {
  return std::exp(-0.5 * (x * x / (wide * wide) + y * y / (high * high)));
}

/// The coordinate at each step of an arc length counted from the middle of `along`, where the height is a function of
/// it.
template <class Slope>
void walk(double* along, int half, double step, const Slope& slope) {
  along[half] = 0.0;
  for (const int sense : {-1, 1}) {
    for (int i = 1; i <= half; ++i) {
      const double before = along[half + sense * (i - 1)];
      const double guess = before + sense * 0.5 * step / std::hypot(1.0, slope(before));
      along[half + sense * i] = before + sense * step / std::hypot(1.0, slope(guess));
    }
  }
}

}  // namespace

double SyntheticBody::heightAt(double x, double y) const {
  constexpr double kBladesAt = 85.0;
  const double blades = bump(x - shape_.blade_apart_mm, y - kBladesAt, 38.0, 58.0) +
                        bump(x + shape_.blade_apart_mm, y - kBladesAt, 38.0, 58.0);
  // The furrow is deepest at the small of the back.
  const double depth = shape_.furrow_mm * (0.6 + 0.4 * bump(0.0, y + 90.0, 1.0, 70.0));
  return -shape_.flank_mm * std::pow(std::abs(x) / kHalfWidthMm, shape_.flank_power) +
         shape_.sway_mm * std::cos(y / 95.0 - 0.6) + shape_.blade_mm * blades -
         depth * bump(x, 0.0, shape_.furrow_width_mm, 1.0);
}

SyntheticBody::SyntheticBody(const BackShape& shape)
    : shape_(shape), row_y_(2 * kHalfRows + 1), column_x_(row_y_.size() * kColumns) {
  constexpr double kStep = 0.01;
  walk(row_y_.data(), kHalfRows, kRowStep,
       [&](double y) { return (heightAt(0.0, y + kStep) - heightAt(0.0, y - kStep)) / (2.0 * kStep); });
  for (std::size_t row = 0; row < row_y_.size(); ++row) {
    const double y = row_y_[row];
    walk(&column_x_[row * kColumns], kHalfColumns, kColumnStep,
         [&](double x) { return (heightAt(x + kStep, y) - heightAt(x - kStep, y)) / (2.0 * kStep); });
  }
}

Vec3 SyntheticBody::placeAt(const Vec2& skin_mm) const {
  const double row = std::clamp(skin_mm.y() / kRowStep + kHalfRows, 0.0, 2.0 * kHalfRows - 1e-9);
  const double column = std::clamp(skin_mm.x() / kColumnStep + kHalfColumns, 0.0, 2.0 * kHalfColumns - 1e-9);
  const auto i = static_cast<std::size_t>(row);
  const auto j = static_cast<std::size_t>(column);
  const double up = row - static_cast<double>(i);
  const double right = column - static_cast<double>(j);
  const double* below = &column_x_[i * kColumns + j];
  const double* above = below + kColumns;
  const double x =
      (1.0 - up) * ((1.0 - right) * below[0] + right * below[1]) + up * ((1.0 - right) * above[0] + right * above[1]);
  const double y = (1.0 - up) * row_y_[i] + up * row_y_[i + 1];
  return {x, y, heightAt(x, y)};
}

Vec3 SyntheticBody::normalAt(const Vec2& skin_mm) const {
  constexpr double kStep = 0.5;
  const Vec3 right = placeAt(skin_mm + Vec2(kStep, 0.0)) - placeAt(skin_mm - Vec2(kStep, 0.0));
  const Vec3 up = placeAt(skin_mm + Vec2(0.0, kStep)) - placeAt(skin_mm - Vec2(0.0, kStep));
  return right.cross(up).normalized();
}

Vec3 SyntheticBody::pressedAt(const Vec2& skin_mm, const TrueField& field) const {
  const Vec2 dragged = skin_mm + field.displacementAt(skin_mm);
  const double dent = field.dentAt(skin_mm);
  if (dent < 1e-6) return placeAt(dragged);
  return placeAt(dragged) - dent * normalAt(dragged);
}

Vec3 movedBody(const Vec3& place, const BodyMotion& motion) {
  const double angle = motion.turn_rad.norm();
  const Vec3 turned = angle > 0.0 ? Vec3(Eigen::AngleAxisd(angle, motion.turn_rad / angle) * place) : place;
  return (1.0 + motion.scale) * turned + motion.shift_mm;
}

}  // namespace palpate::measure
