// Exact orientation of four points: a floating-point filter first, exact sums of triple products when it cannot decide.
//
// Every function here relies on each operation being rounded once, to nearest: never compile it with contraction
// (-ffp-contract=off, set for the whole project) or -ffast-math.
//
// Based on: Shewchuk (1997) for the filter's bound and the growing expansion, Dekker (1971) for the exact product,
// Knuth (TAOCP 2, 4.2.2) for the exact sum.
#include "palpate/tree/exact_predicates.h"

#include <array>
#include <cmath>

namespace palpate::tree {

namespace {

/// Half an ulp of 1: the largest relative rounding error of one operation.
constexpr double kUnitRoundoff = 0x1.0p-53;
/// Rounding of the 3x3 determinant of rounded differences, relative to its permanent (Shewchuk 1997, section 4.3).
constexpr double kFilterBound = (7.0 + 56.0 * kUnitRoundoff) * kUnitRoundoff;
/// 2^27 + 1 splits a double into two halves of 26 bits whose products are exact (Dekker).
constexpr double kSplitter = 134217729.0;

/// A number as the unevaluated sum high + low, low being what rounding took away from high.
struct Pair {
  double high;
  double low;
};

Pair exactSum(double a, double b) {
  const double sum = a + b;
  const double b_part = sum - a;
  const double a_part = sum - b_part;
  return {sum, (a - a_part) + (b - b_part)};
}

Pair split(double a) {
  const double scaled = kSplitter * a;
  const double high = scaled - (scaled - a);
  return {high, a - high};
}

Pair exactProduct(double a, double b) {
  const double product = a * b;
  const Pair sa = split(a);
  const Pair sb = split(b);
  const double error = ((product - sa.high * sb.high) - sa.low * sb.high) - sa.high * sb.low;
  return {product, sa.low * sb.low - error};
}

/// An exact sum of doubles: terms that do not overlap, smallest first, without zeros. The largest carries the sign.
class ExactSum {
 public:
  void add(double value) {
    int kept = 0;
    for (int i = 0; i < size_; ++i) {
      const Pair sum = exactSum(value, terms_[i]);
      if (sum.low != 0.0) terms_[kept++] = sum.low;
      value = sum.high;
    }
    if (value != 0.0) terms_[kept++] = value;
    size_ = kept;
  }

  /// Adds a b c, which needs four doubles.
  void addProduct(double a, double b, double c) {
    const Pair ab = exactProduct(a, b);
    for (const Pair part : {exactProduct(ab.low, c), exactProduct(ab.high, c)}) {
      add(part.low);
      add(part.high);
    }
  }

  int sign() const {
    if (size_ == 0) return 0;
    return terms_[size_ - 1] > 0.0 ? 1 : -1;
  }

 private:
  static constexpr int kMaxTerms = 96;  // 24 triple products of 4 doubles
  std::array<double, kMaxTerms> terms_;
  int size_ = 0;
};

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
