// Sums of products of doubles without any rounding, for questions whose answer is a sign.
//
// Every function here relies on each operation being rounded once, to nearest: never compile it with contraction
// (-ffp-contract=off, set for the whole project) or -ffast-math. Exact as long as the products neither overflow nor
// underflow.
//
// Based on: Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates" (1997), the
// growing expansion; Dekker (1971), the exact product; Knuth (TAOCP 2, 4.2.2), the exact sum.
#pragma once

#include <array>
#include <cmath>

#include "palpate/base/vec.h"

namespace palpate {

/// Half an ulp of 1: the largest relative rounding error of one operation.
inline constexpr double kUnitRoundoff = 0x1.0p-53;

/// A number as the unevaluated sum high + low, low being what rounding took away from high.
struct DoublePair {
  double high;
  double low;
};

inline DoublePair exactSum(double a, double b) noexcept {
  const double sum = a + b;
  const double b_part = sum - a;
  const double a_part = sum - b_part;
  return {sum, (a - a_part) + (b - b_part)};
}

/// Splits into two halves of 26 bits, whose products are exact.
inline DoublePair inHalves(double a) noexcept {
  constexpr double kSplitter = 134217729.0;  // 2^27 + 1 (Dekker)
  const double scaled = kSplitter * a;
  const double high = scaled - (scaled - a);
  return {high, a - high};
}

inline DoublePair exactProduct(double a, double b) noexcept {
  const double product = a * b;
  const DoublePair sa = inHalves(a);
  const DoublePair sb = inHalves(b);
  const double error = ((product - sa.high * sb.high) - sa.low * sb.high) - sa.high * sb.low;
  return {product, sa.low * sb.low - error};
}

/// An exact sum of doubles: terms that do not overlap, smallest first, without zeros. The largest carries the sign.
class ExactSum {
 public:
  void add(double value) noexcept {
    int kept = 0;
    for (int i = 0; i < size_; ++i) {
      const DoublePair sum = exactSum(value, terms_[i]);
      if (sum.low != 0.0) terms_[kept++] = sum.low;
      value = sum.high;
    }
    if (value != 0.0) terms_[kept++] = value;
    size_ = kept;
  }

  /// Adds a b, which needs two doubles.
  void addProduct(double a, double b) noexcept {
    const DoublePair ab = exactProduct(a, b);
    add(ab.low);
    add(ab.high);
  }

  /// Adds a b c, which needs four.
  void addProduct(double a, double b, double c) noexcept {
    const DoublePair ab = exactProduct(a, b);
    addProduct(ab.low, c);
    addProduct(ab.high, c);
  }

  int sign() const noexcept {
    if (size_ == 0) return 0;
    return terms_[size_ - 1] > 0.0 ? 1 : -1;
  }

 private:
  static constexpr int kMaxTerms = 96;  // 24 triple products of 4 doubles
  std::array<double, kMaxTerms> terms_;
  int size_ = 0;
};

/// Sign of det(b - a, c - a): +1 when c lies to the left of the line from a to b, 0 exactly on it. Exact for
/// magnitudes of 1e-140 to 1e140, or zero.
inline int orient2d(const Vec2& a, const Vec2& b, const Vec2& c) noexcept {
  // Rounding of the determinant of rounded differences, relative to its permanent (Shewchuk 1997, section 4.2).
  constexpr double kFilterBound = (3.0 + 16.0 * kUnitRoundoff) * kUnitRoundoff;
  const double left = (b.x() - a.x()) * (c.y() - a.y());
  const double right = (b.y() - a.y()) * (c.x() - a.x());
  const double bound = kFilterBound * (std::abs(left) + std::abs(right));
  if (left - right > bound) return 1;
  if (right - left > bound) return -1;
  ExactSum sum;
  sum.addProduct(a.x(), b.y());
  sum.addProduct(-a.x(), c.y());
  sum.addProduct(b.x(), c.y());
  sum.addProduct(-b.x(), a.y());
  sum.addProduct(c.x(), a.y());
  sum.addProduct(-c.x(), b.y());
  return sum.sign();
}

}  // namespace palpate
