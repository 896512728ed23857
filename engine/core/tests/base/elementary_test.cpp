// The elementary functions against MPFR, which computes them to any number of digits and shares nothing with them.
// 20,000 arguments of each kind here; PALPATE_HEAVY=1 (tools/test-heavy) takes 10^7 of each function.
#include "palpate/base/elementary.h"

#include <gtest/gtest.h>
#include <mpfr.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>

#include "palpate/base/random.h"

namespace palpate {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
/// Promised is 1.
constexpr double kWorstUlp = 0.85;

std::size_t argumentCount(std::size_t kinds) {
  return std::getenv("PALPATE_HEAVY") == nullptr ? 20'000 : 10'000'000 / kinds;
}

/// A number of MPFR's, to 200 bits.
class Exact {
 public:
  explicit Exact(double value = 0.0) {
    mpfr_init2(number_, 200);
    mpfr_set_d(number_, value, MPFR_RNDN);
  }
  ~Exact() { mpfr_clear(number_); }
  Exact(const Exact&) = delete;
  Exact& operator=(const Exact&) = delete;
  mpfr_ptr get() { return number_; }

  /// How far `value` is from this, in units of the last bit that a double of this size has.
  double ulpsTo(double value) {
    if (mpfr_regular_p(number_) == 0) {  // zero, infinity, not a number: no exponent
      const double special = mpfr_get_d(number_, MPFR_RNDN);
      return value == special || (std::isnan(value) && std::isnan(special)) ? 0.0 : kInfinity;
    }
    if (std::isinf(value) && mpfr_get_exp(number_) > 1024) return 0.0;
    const long unit = std::max<long>(mpfr_get_exp(number_) - 53, -1074);
    Exact distance(value);
    mpfr_sub(distance.get(), distance.get(), number_, MPFR_RNDN);
    mpfr_mul_2si(distance.get(), distance.get(), -unit, MPFR_RNDN);
    return std::abs(mpfr_get_d(distance.get(), MPFR_RNDN));
  }

 private:
  mpfr_t number_;
};

using Argument = std::function<double(Random&)>;

Argument between(double low, double high) {
  return [=](Random& random) { return random.uniform(low, high); };
}

/// Any finite double: its bits are drawn.
double anyDouble(Random& random) {
  for (;;) {
    const auto value = std::bit_cast<double>(random.bits());
    if (std::isfinite(value)) return value;
  }
}

/// Around a number, from far to its neighbours.
Argument near(double centre) {
  return [=](Random& random) {
    const int steps = static_cast<int>(random.below(60));
    return centre + std::ldexp(random.uniform(-1.0, 1.0), -steps);
  };
}

/// The doubles nearest to multiples of pi / 2.
double nearQuarterTurn(Random& random) {
  return static_cast<double>(random.below(std::uint64_t{1} << (1 + random.below(52)))) * 1.5707963267948966;
}

using Function = double (*)(double) noexcept;
using ExactFunction = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);

void expectWithinAnUlp(Function ours, ExactFunction exact, const std::vector<Argument>& kinds) {
  Random random(34);
  Exact result;
  double worst = 0.0;
  double at = 0.0;
  for (const Argument& kind : kinds) {
    for (std::size_t i = 0; i < argumentCount(kinds.size()); ++i) {
      const double x = kind(random);
      Exact argument(x);
      exact(result.get(), argument.get(), MPFR_RNDN);
      if (mpfr_nan_p(result.get()) != 0) {
        ASSERT_TRUE(std::isnan(ours(x))) << x;
        continue;
      }
      const double ulps = result.ulpsTo(ours(x));
      if (!(ulps <= worst)) {
        worst = ulps;
        at = x;
      }
    }
  }
  EXPECT_LE(worst, kWorstUlp) << "at " << at;
}

using Function2 = double (*)(double, double) noexcept;
using ExactFunction2 = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t);
struct Two {
  double first, second;
};
using Arguments2 = std::function<Two(Random&)>;

void expectWithinAnUlp(Function2 ours, ExactFunction2 exact, const std::vector<Arguments2>& kinds) {
  Random random(34);
  Exact result;
  double worst = 0.0;
  Two at = {0.0, 0.0};
  for (const Arguments2& kind : kinds) {
    for (std::size_t i = 0; i < argumentCount(kinds.size()); ++i) {
      const Two x = kind(random);
      Exact first(x.first);
      Exact second(x.second);
      exact(result.get(), first.get(), second.get(), MPFR_RNDN);
      const double ulps = result.ulpsTo(ours(x.first, x.second));
      if (!(ulps <= worst)) {
        worst = ulps;
        at = x;
      }
    }
  }
  EXPECT_LE(worst, kWorstUlp) << "at " << at.first << ", " << at.second;
}

Two bothAny(Random& random) {
  const double first = anyDouble(random);
  return {first, anyDouble(random)};
}

/// Of sizes that have to do with one another.
Two ofOneSize(Random& random) {
  const double first = std::ldexp(random.uniform(-1.0, 1.0), static_cast<int>(random.below(2000)) - 1000);
  const int apart = static_cast<int>(random.below(70)) - 35;
  return {first, std::ldexp(first * random.uniform(-2.0, 2.0), apart)};
}

}  // namespace

TEST(Elementary, ExponentialsAreWithinAnUlp) {
  expectWithinAnUlp(elementary::exp, mpfr_exp, {between(-746.0, 710.0), between(-1.0, 1.0), between(-745.2, -708.0)});
  expectWithinAnUlp(elementary::exp2, mpfr_exp2, {between(-1076.0, 1025.0), between(-1.0, 1.0)});
  expectWithinAnUlp(elementary::expm1, mpfr_expm1, {between(-45.0, 710.0), between(-1.0, 1.0), near(0.0)});
}

TEST(Elementary, LogarithmsAreWithinAnUlp) {
  const Argument any = [](Random& random) { return std::abs(anyDouble(random)); };
  expectWithinAnUlp(elementary::log, mpfr_log, {any, between(0.5, 2.0), near(1.0)});
  expectWithinAnUlp(elementary::log2, mpfr_log2, {any, between(0.5, 2.0), near(1.0)});
  expectWithinAnUlp(elementary::log1p, mpfr_log1p, {any, between(-1.0, 10.0), near(0.0)});
}

TEST(Elementary, AnglesOfAnySizeAreWithinAnUlp) {
  const std::vector<Argument> kinds = {anyDouble, between(-4.0, 4.0), between(-2e6, 2e6), nearQuarterTurn, near(0.0)};
  expectWithinAnUlp(elementary::sin, mpfr_sin, kinds);
  expectWithinAnUlp(elementary::cos, mpfr_cos, kinds);
  expectWithinAnUlp(elementary::tan, mpfr_tan, kinds);
  expectWithinAnUlp(elementary::atan2, mpfr_atan2, {bothAny, ofOneSize});
}

TEST(Elementary, PowersAndLengthsAreWithinAnUlp) {
  const Arguments2 any_result = [](Random& random) {
    const double x = std::abs(anyDouble(random));
    return Two{x, random.uniform(-746.0, 710.0) / std::log(x)};
  };
  const Arguments2 near_one = [](Random& random) {
    const double x = near(1.0)(random);
    return Two{std::abs(x), random.uniform(-740.0, 709.0) / std::log(std::abs(x))};
  };
  const Arguments2 usual = [](Random& random) {
    const double x = random.uniform(0.0, 10.0);
    return Two{x, random.uniform(-5.0, 5.0)};
  };
  expectWithinAnUlp(elementary::pow, mpfr_pow, {any_result, near_one, usual});
  expectWithinAnUlp(elementary::hypot, mpfr_hypot, {bothAny, ofOneSize});
}

TEST(Elementary, TanhAndErfAreWithinAnUlp) {
  expectWithinAnUlp(elementary::tanh, mpfr_tanh, {between(-23.0, 23.0), between(-1.0, 1.0), near(0.0)});
  expectWithinAnUlp(elementary::erf, mpfr_erf, {between(-6.5, 6.5), between(-1.0, 1.0), near(0.0)});
}

TEST(Elementary, EdgesAreThoseOfTheStandard) {  // ISO C, Annex F
  EXPECT_EQ(elementary::exp(kInfinity), kInfinity);
  EXPECT_EQ(elementary::exp(-kInfinity), 0.0);
  EXPECT_EQ(elementary::exp(0.0), 1.0);
  EXPECT_EQ(elementary::expm1(-kInfinity), -1.0);
  EXPECT_EQ(elementary::expm1(kInfinity), kInfinity);
  EXPECT_EQ(elementary::log(0.0), -kInfinity);
  EXPECT_EQ(elementary::log(kInfinity), kInfinity);
  EXPECT_EQ(elementary::log(1.0), 0.0);
  EXPECT_EQ(elementary::log1p(-1.0), -kInfinity);
  for (int k = -1074; k < 1024; ++k) EXPECT_EQ(elementary::log2(std::ldexp(1.0, k)), k);
  for (int k = -1074; k < 1024; ++k) EXPECT_EQ(elementary::exp2(k), std::ldexp(1.0, k));
  EXPECT_EQ(elementary::hypot(-kInfinity, kNan), kInfinity);
  EXPECT_EQ(elementary::hypot(3.0, -4.0), 5.0);
  EXPECT_EQ(elementary::tanh(-kInfinity), -1.0);
  EXPECT_EQ(elementary::erf(kInfinity), 1.0);
  for (const Function f :
       {Function(elementary::exp), Function(elementary::exp2), Function(elementary::expm1), Function(elementary::log),
        Function(elementary::log2), Function(elementary::log1p), Function(elementary::sin), Function(elementary::cos),
        Function(elementary::tan), Function(elementary::tanh), Function(elementary::erf)}) {
    EXPECT_TRUE(std::isnan(f(kNan)));
  }
  for (const Function f : {Function(elementary::sin), Function(elementary::cos), Function(elementary::tan)}) {
    EXPECT_TRUE(std::isnan(f(kInfinity)));
  }
  for (const Function f : {Function(elementary::log), Function(elementary::log2)}) EXPECT_TRUE(std::isnan(f(-1.0)));
  for (const Function f : {Function(elementary::sin), Function(elementary::tan), Function(elementary::tanh),
                           Function(elementary::erf), Function(elementary::expm1), Function(elementary::log1p)}) {
    EXPECT_TRUE(std::signbit(f(-0.0)) && f(-0.0) == 0.0);
  }
}

TEST(Elementary, EdgesOfTwoArgumentsAreThoseOfTheCLibrary) {
  const double values[] = {0.0,   1.0,    0.5,    2.0,    3.0,          4.0,       2.5,
                           1e300, 1e-300, 5e-324, 0x1p53, 0x1p53 + 2.0, kInfinity, kNan};
  const auto same = [](double a, double b) {
    return (std::isnan(a) && std::isnan(b)) || std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
  };
  for (const double x : values) {
    for (const double y : values) {
      for (const auto& [a, b] : {Two{x, y}, Two{-x, y}, Two{x, -y}, Two{-x, -y}}) {
        EXPECT_TRUE(same(elementary::pow(a, b), std::pow(a, b))) << a << " to the power " << b;
        EXPECT_TRUE(same(elementary::atan2(a, b), std::atan2(a, b))) << a << " over " << b;
        EXPECT_TRUE(same(elementary::hypot(a, b), std::hypot(a, b))) << a << " and " << b;
      }
    }
  }
}

// Results that another compiler or processor must give, too.
TEST(Elementary, GiveTheKeptBits) {
  Random random(1);
  std::uint64_t bits = 0;
  for (int i = 0; i < 100'000; ++i) {
    const double x = random.uniform(-20.0, 20.0);
    const double y = random.uniform(0.0, 5.0);
    for (const double value :
         {elementary::exp(x), elementary::exp2(x), elementary::expm1(x), elementary::log(y), elementary::log2(y),
          elementary::log1p(y), elementary::pow(y, x), elementary::sin(x), elementary::cos(1e9 * x), elementary::tan(x),
          elementary::atan2(x, y), elementary::hypot(x, y), elementary::tanh(x), elementary::erf(x)}) {
      bits = (bits ^ std::bit_cast<std::uint64_t>(value)) * 0x100000001b3u;
    }
  }
  EXPECT_EQ(bits, 5537192728425342020u);
}

}  // namespace palpate
