#include "palpate/base/number_range.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace palpate {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

TEST(NumberRange, HoldsItsEndsUnlessItIsAboveTheLowOne) {
  EXPECT_TRUE((NumberRange{0.0, 5.0}.holds(0.0)));
  EXPECT_TRUE((NumberRange{0.0, 5.0}.holds(5.0)));
  EXPECT_FALSE((NumberRange{0.0, 5.0, true}.holds(0.0)));
  EXPECT_FALSE((NumberRange{0.0, 5.0}.holds(5.1)));
  EXPECT_FALSE(NumberRange{}.holds(std::nan("")));
}

TEST(NumberRange, ReadsLikeASentence) {
  EXPECT_EQ((NumberRange{0.0, 10800.0}.words("s")), "0 to 10,800 s");
  EXPECT_EQ((NumberRange{0.0, 0.25, true}.words("mm")), "above 0 and at most 0.25 mm");
  EXPECT_EQ((NumberRange{-1e5, kInfinite}.words()), "at least -100,000");
  EXPECT_EQ((NumberRange{-kInfinite, 3.0}.words()), "at most 3");
  EXPECT_EQ(NumberRange{}.words("mm"), "");
  EXPECT_EQ(outOfRange("1e12", {0.0, 10800.0}, "s"), "1e12 is out of range: 0 to 10,800 s");
}

TEST(ReadableNumber, PutsCommasIntoWholeNumbersOnly) {
  EXPECT_EQ(readableNumber(999.0), "999");
  EXPECT_EQ(readableNumber(1000.0), "1,000");
  EXPECT_EQ(readableNumber(-1234567.0), "-1,234,567");
  EXPECT_EQ(readableNumber(1234.5), "1234.5");
  EXPECT_EQ(readableNumber(1e-9), "1e-09");
  EXPECT_EQ(readableNumber(1e300), "1e+300");
}

}  // namespace
}  // namespace palpate
