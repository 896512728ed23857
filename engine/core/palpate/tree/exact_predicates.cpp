// Exact orientation of four points: a floating-point filter first, exact sums of triple products when it cannot decide.
//
// Based on: Shewchuk (1997) for the filter's bound.
#include "palpate/tree/exact_predicates.h"

#include <cmath>

#include "palpate/base/exact_sum.h"

namespace palpate::tree {

namespace {

/// Rounding of the 3x3 determinant of rounded differences, relative to its permanent (Shewchuk 1997, section 4.3).
constexpr double kFilterBound = (7.0 + 56.0 * kUnitRoundoff) * kUnitRoundoff;

/// Adds sign * det(u, v, w), six triple products.
void addDeterminant(ExactSum& sum, double sign, const Vec3& u, const Vec3& v, const Vec3& w) {
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    sum.addProduct(sign * u[i], v[j], w[k]);
    sum.addProduct(-sign * u[i], v[k], w[j]);
  }
}

bool differenceIsExact(const Vec3& a, const Vec3& b) {
  return exactSum(a.x(), -b.x()).low == 0.0 && exactSum(a.y(), -b.y()).low == 0.0 && exactSum(a.z(), -b.z()).low == 0.0;
}

int exactOrientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  ExactSum sum;
  if (differenceIsExact(b, a) && differenceIsExact(c, a) && differenceIsExact(d, a)) {
    addDeterminant(sum, 1.0, b - a, c - a, d - a);
    return sum.sign();
  }
  // det(b - a, c - a, d - a) without a difference: multilinear in the coordinates as they are.
  addDeterminant(sum, 1.0, b, c, d);
  addDeterminant(sum, -1.0, a, c, d);
  addDeterminant(sum, 1.0, a, b, d);
  addDeterminant(sum, -1.0, a, b, c);
  return sum.sign();
}

/// True when three signs do not contradict each other; zero agrees with both.
bool agree(int first, int second, int third) {
  const bool any_positive = first > 0 || second > 0 || third > 0;
  const bool any_negative = first < 0 || second < 0 || third < 0;
  return !(any_positive && any_negative);
}

}  // namespace

int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) noexcept {
  const double ux = b.x() - a.x(), uy = b.y() - a.y(), uz = b.z() - a.z();
  const double vx = c.x() - a.x(), vy = c.y() - a.y(), vz = c.z() - a.z();
  const double wx = d.x() - a.x(), wy = d.y() - a.y(), wz = d.z() - a.z();
  const double ux_vy = ux * vy, uy_vx = uy * vx;
  const double uy_vz = uy * vz, uz_vy = uz * vy;
  const double uz_vx = uz * vx, ux_vz = ux * vz;
  const double determinant = (ux_vy - uy_vx) * wz + (uy_vz - uz_vy) * wx + (uz_vx - ux_vz) * wy;
  const double permanent = (std::abs(ux_vy) + std::abs(uy_vx)) * std::abs(wz) +
                           (std::abs(uy_vz) + std::abs(uz_vy)) * std::abs(wx) +
                           (std::abs(uz_vx) + std::abs(ux_vz)) * std::abs(wy);
  const double bound = kFilterBound * permanent;
  if (determinant > bound) return 1;
  if (-determinant > bound) return -1;
  return exactOrientation(a, b, c, d);
}

bool crossesFrontToBack(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& from, const Vec3& to) noexcept {
  if (orient3d(a, b, c, to) >= 0 || orient3d(a, b, c, from) < 0) return false;
  return agree(orient3d(from, to, a, b), orient3d(from, to, b, c), orient3d(from, to, c, a));
}

}  // namespace palpate::tree
