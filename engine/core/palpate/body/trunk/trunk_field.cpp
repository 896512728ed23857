// Decodes the table and evaluates its tricubic spline with its gradient; 64 coefficients a point, about 0.1 us.
#include "palpate/body/trunk/trunk_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string_view>

#include "palpate/body/trunk/trunk_table.h"

namespace palpate::body {

namespace {

#include "palpate/body/trunk/trunk_numbers.inc"

constexpr double kFarMm = 70.0;  // meaning of a sign in the table: beyond every coefficient that matters
constexpr int kNewtonRounds = 6;
constexpr double kOnSkinMm = 1e-6;
constexpr double kLongestStepMm = 12.0;  // where two parts of the skin are near, a longer step would change sides

/// The value of a digit: its place among the characters that are digits.
int decodeDigit(char character) {
  constexpr std::string_view kNoDigits = "+-?\\";
  int value = character - '#';
  for (const char other : kNoDigits) value -= other < character ? 1 : 0;
  return value;
}

std::vector<double> decoded() {
  std::vector<double> coefficients;
  coefficients.reserve(static_cast<std::size_t>(kTrunkTableX) * kTrunkTableY * kTrunkTableZ);
  constexpr int kMiddle = kTrunkTableBase * kTrunkTableBase / 2;
  constexpr std::string_view kTable(kTrunkTable, std::size(kTrunkTable) - 1);
  for (std::size_t i = 0; i < kTable.size(); ++i) {
    const char first = kTable[i];
    if (first == '+' || first == '-') {
      coefficients.push_back(first == '+' ? kFarMm : -kFarMm);
      continue;
    }
    const int digits = kTrunkTableBase * decodeDigit(first) + decodeDigit(kTable[++i]);
    coefficients.push_back(kTrunkTableUnitMm * (digits - kMiddle));
  }
  return coefficients;
}

/// The four cubic B-splines that reach a place, and their derivatives by the place, and the first one's number.
struct Axis {
  int first;
  std::array<double, 4> weight, slope;

  Axis(double place, int least, int count) {
    const double inside = std::clamp(place, static_cast<double>(least), static_cast<double>(count) - 3.0);
    const int cell = std::min(static_cast<int>(inside), count - 3);
    first = cell - 1;
    const double t = inside - cell;
    const double s = 1.0 - t;
    weight = {s * s * s / 6.0, (3 * t * t * t - 6 * t * t + 4) / 6.0, (3 * s * s * s - 6 * s * s + 4) / 6.0,
              t * t * t / 6.0};
    slope = {-0.5 * s * s, 1.5 * t * t - 2.0 * t, -1.5 * s * s + 2.0 * s, 0.5 * t * t};
  }
};

}  // namespace

TrunkField::TrunkField() : coefficients_(decoded()) {}

TrunkField::Value TrunkField::at(const Vec3& point) const {
  const Axis x(std::abs(point.x()) / kTrunkTableStepMm, 0, kTrunkTableX);
  const Axis y((point.y() - kTrunkTableLowY) / kTrunkTableStepMm + 1.0, 1, kTrunkTableY);
  const Axis z((point.z() - kTrunkTableLowZ) / kTrunkTableStepMm + 1.0, 1, kTrunkTableZ);
  Value value{0.0, Vec3::Zero()};
  for (std::size_t i = 0; i < 4; ++i) {
    const int across = std::abs(x.first + static_cast<int>(i));
    double sum = 0;
    double along_y = 0;
    double along_z = 0;
    for (std::size_t j = 0; j < 4; ++j) {
      const int row = (across * kTrunkTableY + y.first + static_cast<int>(j)) * kTrunkTableZ + z.first;
      const double* c = coefficients_.data() + row;
      const double line = z.weight[0] * c[0] + z.weight[1] * c[1] + z.weight[2] * c[2] + z.weight[3] * c[3];
      const double slope = z.slope[0] * c[0] + z.slope[1] * c[1] + z.slope[2] * c[2] + z.slope[3] * c[3];
      sum += y.weight[j] * line;
      along_y += y.slope[j] * line;
      along_z += y.weight[j] * slope;
    }
    value.distance += x.weight[i] * sum;
    value.gradient += Vec3(x.slope[i] * sum, x.weight[i] * along_y, x.weight[i] * along_z);
  }
  value.gradient /= kTrunkTableStepMm;
  if (point.x() < 0) value.gradient.x() = -value.gradient.x();
  return value;
}

SkinPoint TrunkField::project(const Vec3& point) const {
  Vec3 p = point;
  Value value = at(p);
  for (int round = 0; round < kNewtonRounds && std::abs(value.distance) > kOnSkinMm; ++round) {
    const double square = std::max(value.gradient.squaredNorm(), 0.04);
    const double step = std::clamp(value.distance / square, -kLongestStepMm, kLongestStepMm);
    p -= step * value.gradient;
    value = at(p);
  }
  return {p, value.gradient.normalized()};
}

Vec3 TrunkField::outward(const SkinPoint& point) const {
  constexpr double kOutsideMm = 18;
  return at(point.position + kOutsideMm * point.normal).gradient.normalized();
}

Eigen::AlignedBox3d TrunkField::box() {
  const double x = kTrunkTableStepMm * (kTrunkTableX - 3);
  return {Vec3(-x, kTrunkTableLowY, kTrunkTableLowZ), Vec3(x, kTrunkTableLowY + kTrunkTableStepMm * (kTrunkTableY - 4),
                                                           kTrunkTableLowZ + kTrunkTableStepMm * (kTrunkTableZ - 4))};
}

}  // namespace palpate::body
