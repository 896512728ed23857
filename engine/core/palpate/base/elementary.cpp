// Exactness beyond 53 bits is kept as a pair of doubles, `high` rounded and `low` the remainder (Dekker 1971). All
// polynomials are Taylor's: tables (elementary_numbers.txt) make their arguments small.
#include "palpate/base/elementary.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>

namespace palpate::elementary {

namespace {

/// Their sum is meant: `low` is at most half of the last bit of `high`.
struct DoublePair {
  double high, low;
};

#include "palpate/base/elementary_numbers.inc"

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
/// Added and subtracted again, it rounds a number below 2^51 to a whole one, ties to even.
constexpr double kRounder = 0x1.8p52;
/// Anything below this share of a number is less than its last bit.
constexpr double kTiny = 0x1p-55;

std::uint64_t bitsOf(double x) { return std::bit_cast<std::uint64_t>(x); }

double doubleFromBits(std::uint64_t bits) { return std::bit_cast<double>(bits); }

/// 2^k for k from -1022 to 1023.
double powerOfTwo(int k) { return doubleFromBits(static_cast<std::uint64_t>(k + 1023) << 52); }

/// value * 2^k, rounded once more where the result is subnormal.
double scaled(double value, int k) {
  if (k > 1023) return value * 0x1p1023 * powerOfTwo(k - 1023 > 1023 ? 1023 : k - 1023);
  if (k >= -1022) return value * powerOfTwo(k);
  return value * powerOfTwo(k + 969 < -1022 ? -1022 : k + 969) * 0x1p-969;
}

// --- pairs

/// Requires |a| >= |b| or a == 0.
DoublePair quickSum(double a, double b) {
  const double high = a + b;
  return {high, b - (high - a)};
}

DoublePair exactSum(double a, double b) {
  const double high = a + b;
  const double of_b = high - a;
  return {high, (a - (high - of_b)) + (b - of_b)};
}

/// The upper 26 bits of a number: a product of two such is exact.
double upperHalf(double x) { return doubleFromBits(bitsOf(x) & 0xfffffffff8000000u); }

/// Nothing is lost above the smallest normal numbers.
DoublePair exactProduct(double a, double b) {
  const double high = a * b;
  const double a_upper = upperHalf(a);
  const double a_lower = a - a_upper;
  const double b_upper = upperHalf(b);
  const double b_lower = b - b_upper;
  return {high, ((a_upper * b_upper - high) + a_upper * b_lower + a_lower * b_upper) + a_lower * b_lower};
}

DoublePair product(DoublePair a, DoublePair b) {
  const DoublePair high = exactProduct(a.high, b.high);
  return quickSum(high.high, high.low + (a.high * b.low + a.low * b.high));
}

/// Requires |a| >= |b|.
DoublePair sum(DoublePair a, DoublePair b) {
  const DoublePair high = exactSum(a.high, b.high);
  return quickSum(high.high, high.low + (a.low + b.low));
}

DoublePair quotient(DoublePair a, DoublePair b) {
  const double high = a.high / b.high;
  const DoublePair back = exactProduct(high, b.high);
  return {high, ((a.high - back.high) - back.low + a.low - high * b.low) / b.high};
}

double rounded(DoublePair a) { return a.high + a.low; }

// --- exponentials: x = (128 k + j) ln 2 / 128 + r, so exp x = 2^k 2^(j / 128) exp r with |r| < 0.0028

struct ExpParts {
  int k;
  const DoublePair* table;  ///< 2^(j / 128)
};

ExpParts partsOfExponent(double whole) {
  const auto n = static_cast<int>(whole);
  return {n >> 7, &kExp2Of128ths[n & 127]};
}

/// (exp r - 1 - r) / r, to 2^-63 of r.
double expTail(double r) {
  return r * (1.0 / 2.0 + r * (1.0 / 6.0 + r * (1.0 / 24.0 + r * (1.0 / 120.0 + r * (1.0 / 720.0)))));
}

/// exp(r) 2^(j / 128) 2^k; `low` adds to r.
double reconstructExp(double whole, double r, double low) {
  const ExpParts parts = partsOfExponent(whole);
  const double beyond_one = r + (low + r * expTail(r));
  const double value = parts.table->high + (parts.table->low + parts.table->high * beyond_one);
  return scaled(value, parts.k);
}

/// Requires |x.high| < 800.
double expOfPair(DoublePair x) {
  const double whole = (x.high * k128OfLn2 + kRounder) - kRounder;
  const DoublePair r = exactSum(x.high - whole * kLn2Of128[0], x.low - whole * kLn2Of128[1]);
  return reconstructExp(whole, r.high, r.low);
}

/// exp x - 1 as a pair, of |x| below 50 and above kTiny.
DoublePair expm1Pair(double x) {
  const double whole = (x * k128OfLn2 + kRounder) - kRounder;
  const DoublePair r = exactSum(x - whole * kLn2Of128[0], -(whole * kLn2Of128[1]));
  const ExpParts parts = partsOfExponent(whole);
  const double two_k = powerOfTwo(parts.k);
  // exp r - 1 = r + r^2 / 2 + ...; the square as a pair, since near zero all of it is the answer.
  const DoublePair square = exactProduct(r.high, r.high);
  const double rest = r.low + r.high * r.low + 0.5 * square.low + r.high * (expTail(r.high) - 0.5 * r.high);
  const DoublePair beyond_one = sum(exactSum(r.high, 0.5 * square.high), {rest, 0.0});
  const DoublePair grown = product({two_k * parts.table->high, two_k * parts.table->low}, beyond_one);
  const DoublePair base = exactSum(two_k * parts.table->high, -1.0);
  const DoublePair high = exactSum(base.high, grown.high);
  return quickSum(high.high, high.low + (base.low + two_k * parts.table->low + grown.low));
}

// --- logarithms: x = 2^k F (1 + u), F = j / 128, so ln x = k ln 2 + ln F + ln(1 + u) with |u| < 0.0056

struct LogParts {
  int k;
  DoublePair log_of_mantissa;  ///< ln F + ln(1 + u)
};

/// Takes the logarithm of (high + low); high is positive and finite, |low| at most half of its last bit.
LogParts logParts(double high, double low) {
  int k = 0;
  if (high < 0x1p-1022) {
    high *= 0x1p54;
    low *= 0x1p54;
    k = -54;
  }
  constexpr std::uint64_t kRootHalf = 0x3fe6a09e667f3bcd;  // mantissas lie between sqrt(1/2) and sqrt(2)
  const std::uint64_t bits = bitsOf(high);
  const int shift = static_cast<int>(static_cast<std::int64_t>(bits - kRootHalf) >> 52);
  const double mantissa = doubleFromBits(bits - (static_cast<std::uint64_t>(static_cast<std::int64_t>(shift)) << 52));
  k += shift;
  const double j = (mantissa * 128.0 + kRounder) - kRounder;
  const double f = j / 128.0;
  const DoublePair log_f = kLogOf128ths[static_cast<int>(j) - kFirstLog];

  const double one_of_f = kOneOf128ths[static_cast<int>(j) - kFirstLog];
  const DoublePair excess = low == 0.0 ? DoublePair{mantissa - f, 0.0} : exactSum(mantissa - f, scaled(low, -shift));
  const double u = excess.high * one_of_f;
  const double u_upper = upperHalf(u);
  const double u_low = (((excess.high - u_upper * f) - (u - u_upper) * f) + excess.low) * one_of_f;
  const DoublePair square = exactProduct(u, u);
  const double tail =
      u * u * u *
      (1.0 / 3.0 -
       u * (1.0 / 4.0 - u * (1.0 / 5.0 - u * (1.0 / 6.0 - u * (1.0 / 7.0 - u * (1.0 / 8.0 - u * (1.0 / 9.0)))))));
  const DoublePair first = exactSum(u, -0.5 * square.high);
  const double first_low = first.low + (u_low - u * u_low - 0.5 * square.low + tail);
  const DoublePair whole = exactSum(log_f.high, first.high);
  return {k, quickSum(whole.high, whole.low + (log_f.low + first_low))};
}

DoublePair logPair(double high, double low) {
  const LogParts parts = logParts(high, low);
  const auto k = static_cast<double>(parts.k);
  const DoublePair whole = exactSum(k * kLn2[0], parts.log_of_mantissa.high);
  return quickSum(whole.high, whole.low + (k * kLn2[1] + parts.log_of_mantissa.low));
}

/// The logarithm of an argument that is not positive and finite.
double logOfSpecial(double x) {
  if (x == 0.0) return -kInfinity;
  return x < 0.0 ? kNan : x;  // infinity and NaN stay what they are
}

// --- powers

/// y is a whole number: odd 1, even 2; else 0.
int integerParity(double y) {
  const double size = std::fabs(y);
  if (size >= 0x1p53) return 2;
  if (size != std::floor(size)) return 0;
  return (static_cast<std::uint64_t>(size) & 1u) != 0 ? 1 : 2;
}

double powOfPositive(double x, double y) {
  const DoublePair log = logPair(x, 0.0);
  const double about = y * log.high;
  if (about > 710.0) return kInfinity;
  if (about < -746.0) return 0.0;
  if (std::fabs(about) < kTiny) return 1.0 + about;
  const DoublePair exponent = exactProduct(y, log.high);
  return expOfPair(quickSum(exponent.high, exponent.low + y * log.low));
}

// --- angles: x = n pi / 2 + r

struct Reduced {
  int quadrant;
  DoublePair rest;  ///< at most pi / 4 and a little
};

/// A row of limbs, the highest first, as one binary number.
std::uint32_t bitsFrom(const std::uint32_t* limbs, int first) {
  const std::uint64_t two = static_cast<std::uint64_t>(limbs[first >> 5]) << 32 | limbs[(first >> 5) + 1];
  return static_cast<std::uint32_t>(two >> (32 - (first & 31)));
}

/// Limbs of 2 / pi that a mantissa is multiplied by: 224 bits, so that at least 94 of the fraction are right however
/// many of its first are zeros (61 at most of any double).
constexpr int kWindow = 7;

/// mantissa * window, whole.
void multiply(std::uint64_t mantissa, const std::uint32_t (&window)[kWindow], std::uint32_t (&result)[kWindow + 2]) {
  constexpr std::uint64_t kLower = 0xffffffffu;
  const std::uint64_t lower = mantissa & kLower;
  const std::uint64_t upper = mantissa >> 32;
  std::uint64_t carry = 0;
  std::uint64_t of_upper = 0;  // the upper limb's product with the window's limb before
  for (int i = kWindow + 1; i >= 0; --i) {
    const std::uint64_t of_lower = i >= 2 ? lower * window[i - 2] : 0;
    const std::uint64_t total = (carry & kLower) + (of_lower & kLower) + (of_upper & kLower);
    result[i] = static_cast<std::uint32_t>(total);
    carry = (carry >> 32) + (of_lower >> 32) + (of_upper >> 32) + (total >> 32);
    of_upper = i >= 2 ? upper * window[i - 2] : 0;
  }
}

/// Payne and Hanek: only the bits of x times 2 / pi that matter, in whole numbers. For x from 2^20.
Reduced reduceLarge(double x) {
  const std::uint64_t bits = bitsOf(x);
  const std::uint64_t mantissa = (bits & 0xfffffffffffffu) | 0x10000000000000u;
  const int exponent = static_cast<int>(bits >> 52) - 1075;  // x = mantissa 2^exponent
  // Bits of 2 / pi before this one make multiples of 4 quadrants.
  const int first = exponent < 2 ? 0 : exponent - 2;
  std::uint32_t window[kWindow];
  for (int i = 0; i < kWindow; ++i) window[i] = bitsFrom(kTwoOfPiBits, first + 32 * i);
  std::uint32_t quadrants[kWindow + 2];
  multiply(mantissa, window, quadrants);
  const int point = 64 + exponent - first;  // number of bits before it
  int quadrant = static_cast<int>(bitsFrom(quadrants, point - 2) >> 30);
  const std::uint32_t flip = bitsFrom(quadrants, point) >> 31 == 0 ? 0 : 0xffffffffu;  // nearer to the next quadrant
  DoublePair rest = {0.0, 0.0};
  double weight = 0x1p-32;
  for (int at = point; at + 64 <= 32 * (kWindow + 2); at += 32) {
    const std::uint32_t limb = bitsFrom(quadrants, at) ^ flip;  // 1 - fraction, but for a last bit that does not matter
    const DoublePair added = exactSum(rest.high, static_cast<double>(limb) * weight);
    rest = quickSum(added.high, added.low + rest.low);
    weight *= 0x1p-32;
  }
  if (flip != 0) {
    ++quadrant;
    rest = {-rest.high, -rest.low};
  }
  return {quadrant & 3, product(rest, kHalfPiPair)};
}

/// Requires finite x.
Reduced reduced(double x) {
  const double size = std::fabs(x);
  if (size <= 0.78539816339744830) return {0, {x, 0.0}};
  if (size >= 0x1p20) {
    const Reduced far = reduceLarge(size);
    if (x > 0.0) return far;
    return {(4 - far.quadrant) & 3, {-far.rest.high, -far.rest.low}};
  }
  const double n = (x * kTwoOfPi + kRounder) - kRounder;
  const DoublePair second = exactSum(x - n * kHalfPi[0], -(n * kHalfPi[1]));
  const DoublePair third = exactSum(second.high, -(n * kHalfPi[2]));
  const DoublePair rest = exactSum(third.high, (third.low + second.low) - n * kHalfPi[3]);
  return {static_cast<int>(static_cast<std::int64_t>(n) & 3), rest};
}

/// The cube's share is up to an eighth of the result, so it is a pair, too.
DoublePair sinOfRest(DoublePair r) {
  const DoublePair square = exactProduct(r.high, r.high);
  const double z = square.high;
  const double tail =
      1.0 / 120.0 +
      z * (-1.0 / 5040.0 + z * (1.0 / 362880.0 + z * (-1.0 / 39916800.0 +
                                                      z * (1.0 / 6227020800.0 + z * (-1.0 / 1307674368000.0 +
                                                                                     z * (1.0 / 355687428096000.0))))));
  const DoublePair cube = product(square, {r.high, 0.0});
  const DoublePair sixth = quotient(cube, {-6.0, 0.0});
  const DoublePair first = quickSum(r.high, sixth.high);
  return quickSum(first.high, first.low + (sixth.low + cube.high * z * tail + r.low * (1.0 - 0.5 * z)));
}

DoublePair cosOfRest(DoublePair r) {
  const DoublePair square = exactProduct(r.high, r.high);
  const double z = square.high;
  const double tail =
      1.0 / 24.0 +
      z * (-1.0 / 720.0 +
           z * (1.0 / 40320.0 +
                z * (-1.0 / 3628800.0 +
                     z * (1.0 / 479001600.0 + z * (-1.0 / 87178291200.0 +
                                                   z * (1.0 / 20922789888000.0 + z * (-1.0 / 6402373705728000.0)))))));
  const DoublePair one_less = quickSum(1.0, -0.5 * z);
  return quickSum(one_less.high, one_less.low + (z * z * tail - 0.5 * square.low - r.high * r.low));
}

double sinReduced(const Reduced& angle) {
  const DoublePair value = (angle.quadrant & 1) == 0 ? sinOfRest(angle.rest) : cosOfRest(angle.rest);
  return (angle.quadrant & 2) == 0 ? rounded(value) : -rounded(value);
}

/// The angle whose tangent is a / b, of 0 <= a <= b, both normal and far from the ends of the range.
DoublePair atanOfShare(double a, double b) {
  const double j = (a / b * 64.0 + kRounder) - kRounder;
  const double c = j / 64.0;
  // tan(t - atan c) = (a - c b) / (b + c a), with exact products: c has seven bits.
  const double b_upper = upperHalf(b);
  const double a_upper = upperHalf(a);
  const DoublePair over = exactSum((a - c * b_upper), -(c * (b - b_upper)));
  const DoublePair first = exactSum(b, c * a_upper);
  const DoublePair under = quickSum(first.high, first.low + c * (a - a_upper));
  const DoublePair t = quotient(over, under);
  const double z = t.high * t.high;
  const double tail = t.high * z * (-1.0 / 3.0 + z * (1.0 / 5.0 + z * (-1.0 / 7.0 + z * (1.0 / 9.0))));
  const DoublePair base = kAtanOf64ths[static_cast<int>(j)];
  const DoublePair whole = exactSum(base.high, t.high);
  return quickSum(whole.high, whole.low + (base.low + t.low + tail));
}

DoublePair difference(DoublePair a, DoublePair b) { return sum(a, {-b.high, -b.low}); }

/// Requires y > 0; x and y finite.
double atan2Upper(double y, double x) {
  const double size_x = std::fabs(x);
  const bool steep = y > size_x;
  double over = steep ? size_x : y;
  double under = steep ? y : size_x;
  if (over < under * 0x1p-60) {  // the angle from the nearest axis is the share itself
    if (!steep && x > 0.0) return over / under;
    const DoublePair axis = steep ? kHalfPiPair : kPiPair;
    return axis.high + (axis.low - (steep ? x : over) / under);
  }
  if (under > 0x1p500) {
    over *= 0x1p-600;
    under *= 0x1p-600;
  } else if (under < 0x1p-400) {
    over *= 0x1p600;
    under *= 0x1p600;
  }
  DoublePair angle = atanOfShare(over, under);
  if (steep) {
    angle = x < 0.0 ? sum(kHalfPiPair, angle) : difference(kHalfPiPair, angle);
  } else if (x < 0.0) {
    angle = difference(kPiPair, angle);
  }
  return rounded(angle);
}

}  // namespace

double exp(double x) noexcept {
  if (!(std::fabs(x) < 708.0)) {  // the ends of the range, and NaN
    if (x > 709.8) return kInfinity;
    if (x < -745.2) return 0.0;
    if (x != x) return x;
  }
  const double whole = (x * k128OfLn2 + kRounder) - kRounder;
  return reconstructExp(whole, (x - whole * kLn2Of128[0]) - whole * kLn2Of128[1], 0.0);
}

double exp2(double x) noexcept {
  if (!(std::fabs(x) < 1022.0)) {
    if (x >= 1024.0) return kInfinity;
    if (x < -1075.0) return 0.0;
    if (x != x) return x;
  }
  const double whole = (x * 128.0 + kRounder) - kRounder;
  return reconstructExp(whole, (x - whole / 128.0) * std::numbers::ln2, 0.0);
}

double expm1(double x) noexcept {
  if (x != x || std::fabs(x) < kTiny) return x;
  if (x > 50.0) return exp(x);  // 1 is below the last bit
  if (x < -40.0) return -1.0;
  return rounded(expm1Pair(x));
}

double log(double x) noexcept {
  if (!(x > 0.0 && x < kInfinity)) return logOfSpecial(x);
  return rounded(logPair(x, 0.0));
}

double log2(double x) noexcept {
  if (!(x > 0.0 && x < kInfinity)) return logOfSpecial(x);
  const LogParts parts = logParts(x, 0.0);
  const DoublePair of_mantissa = product(parts.log_of_mantissa, kOneOfLn2);
  const DoublePair whole = exactSum(static_cast<double>(parts.k), of_mantissa.high);
  return whole.high + (whole.low + of_mantissa.low);
}

double log1p(double x) noexcept {
  if (std::fabs(x) < kTiny) return x;
  if (!(x > -1.0 && x < kInfinity)) return x == -1.0 ? -kInfinity : logOfSpecial(x);
  const DoublePair one_more = exactSum(1.0, x);
  return rounded(logPair(one_more.high, one_more.low));
}

double pow(double x, double y) noexcept {
  if (y == 0.0 || x == 1.0) return 1.0;
  if (x != x || y != y) return x + y;
  const double size = std::fabs(x);
  if (std::fabs(y) == kInfinity) {
    if (size == 1.0) return 1.0;
    return (size > 1.0) == (y > 0.0) ? kInfinity : 0.0;
  }
  const int parity = integerParity(y);
  const bool negative = std::signbit(x) && parity == 1;
  if (size == 0.0 || size == kInfinity) {
    const double value = (size == 0.0) == (y > 0.0) ? 0.0 : kInfinity;
    return negative ? -value : value;
  }
  if (x < 0.0 && parity == 0) return kNan;
  const double value = powOfPositive(size, y);
  return negative ? -value : value;
}

double sin(double x) noexcept {
  if (!(std::fabs(x) < kInfinity)) return kNan;
  if (std::fabs(x) < 0x1p-27) return x;
  return sinReduced(reduced(x));
}

double cos(double x) noexcept {
  if (!(std::fabs(x) < kInfinity)) return kNan;
  Reduced angle = reduced(x);
  ++angle.quadrant;
  return sinReduced(angle);
}

double tan(double x) noexcept {
  if (!(std::fabs(x) < kInfinity)) return kNan;
  if (std::fabs(x) < 0x1p-27) return x;
  const Reduced angle = reduced(x);
  const DoublePair sine = sinOfRest(angle.rest);
  const DoublePair cosine = cosOfRest(angle.rest);
  if ((angle.quadrant & 1) == 0) return rounded(quotient(sine, cosine));
  return -rounded(quotient(cosine, sine));
}

double atan2(double y, double x) noexcept {
  if (x != x || y != y) return x + y;
  const double size_y = std::fabs(y);
  double angle = 0.0;
  if (size_y == 0.0) {
    angle = std::signbit(x) ? kPiPair.high : 0.0;
  } else if (size_y == kInfinity || std::fabs(x) == kInfinity) {
    const double eighths =
        size_y < kInfinity ? (x > 0.0 ? 0.0 : 4.0) : (std::fabs(x) < kInfinity ? 2.0 : (x > 0.0 ? 1.0 : 3.0));
    angle = eighths * (0.25 * kPiPair.high);
  } else {
    angle = atan2Upper(size_y, x);
  }
  return std::signbit(y) ? -angle : angle;
}

double hypot(double x, double y) noexcept {
  double large = std::fabs(x);
  double small = std::fabs(y);
  if (large == kInfinity || small == kInfinity) return kInfinity;
  if (large < small) std::swap(large, small);
  if (!(small > large * 0x1p-54)) return large + small;  // the smaller one does not show; or both are 0; or NaN
  double back = 1.0;
  if (large > 0x1p500) {
    back = 0x1p600;
    large *= 0x1p-600;
    small *= 0x1p-600;
  } else if (small < 0x1p-400) {
    back = 0x1p-600;
    large *= 0x1p600;
    small *= 0x1p600;
  }
  const DoublePair a = exactProduct(large, large);
  const DoublePair b = exactProduct(small, small);
  const DoublePair square = quickSum(a.high, b.high);
  const double low = square.low + (a.low + b.low);
  const double root = std::sqrt(square.high);
  const DoublePair again = exactProduct(root, root);
  return back * (root + ((square.high - again.high) - again.low + low) / (2.0 * root));
}

double tanh(double x) noexcept {
  const double size = std::fabs(x);
  if (x != x || size < 0x1p-27) return x;
  double value = 1.0;
  if (size < 22.0) {
    const DoublePair grown = expm1Pair(2.0 * size);
    value = rounded(quotient(
        grown, sum(grown.high > 2.0 ? grown : DoublePair{2.0, 0.0}, grown.high > 2.0 ? DoublePair{2.0, 0.0} : grown)));
  }
  return std::signbit(x) ? -value : value;
}

double erf(double x) noexcept {
  const double size = std::fabs(x);
  if (x != x) return x;
  double value = 1.0;
  if (size < 6.0) {
    const double j = (size * 16.0 + kRounder) - kRounder;
    const double c = j / 16.0;
    const double h = size - c;
    // The slope from c on is exp(-2 c h - h^2); its Taylor coefficients g follow from one another.
    double before = 1.0;
    double g = -2.0 * c;
    double power = h * h;
    double tail = 0.5 * g * power;
    for (int n = 2; n < 16; ++n) {
      const double next = (-2.0 * c * g - 2.0 * before) / n;
      before = g;
      g = next;
      power *= h;
      tail += g * power / (n + 1);
    }
    const int at = static_cast<int>(j);
    const DoublePair first = exactProduct(kErfSlopeOf16ths[at], h);
    const DoublePair whole = exactSum(kErfOf16ths[at].high, first.high);
    value = whole.high + (whole.low + (kErfOf16ths[at].low + first.low + kErfSlopeOf16ths[at] * tail));
  }
  return std::signbit(x) ? -value : value;
}

}  // namespace palpate::elementary
