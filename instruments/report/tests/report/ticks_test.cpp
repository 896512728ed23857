// Axes stand on round numbers.
#include "report/charts/ticks.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palpate::figures {

namespace {

std::vector<std::string> texts(const std::vector<Tick>& ticks) {
  std::vector<std::string> found;
  found.reserve(ticks.size());
  for (const Tick& tick : ticks) found.push_back(tick.text);
  return found;
}

}  // namespace

TEST(Ticks, StepsAreOneTwoOrFiveTimesAPowerOfTen) {
  EXPECT_DOUBLE_EQ(niceStep(10.0, 5), 2.0);
  EXPECT_DOUBLE_EQ(niceStep(10.0, 10), 1.0);
  EXPECT_DOUBLE_EQ(niceStep(0.7, 4), 0.2);
  EXPECT_DOUBLE_EQ(niceStep(41582.0, 6), 10000.0);
  for (double length = 0.013; length < 1e5; length *= 1.37) {
    const double step = niceStep(length, 7);
    EXPECT_LE(length / step, 7.0 + 1e-9);
    const double lead = step / std::pow(10.0, std::floor(std::log10(step) + 1e-9));
    EXPECT_TRUE(std::abs(lead - 1.0) < 1e-9 || std::abs(lead - 2.0) < 1e-9 || std::abs(lead - 5.0) < 1e-9) << step;
  }
}

TEST(Ticks, ARangeReachesTheNextRoundNumbers) {
  const Range range = niceRange({0.13, 9.4}, Scale::linear, 5);
  EXPECT_DOUBLE_EQ(range.from, 0.0);
  EXPECT_DOUBLE_EQ(range.to, 10.0);
  const Range single = niceRange({4.0, 4.0}, Scale::linear, 5);
  EXPECT_LT(single.from, 4.0);
  EXPECT_GT(single.to, 4.0);
}

TEST(Ticks, WriteAsFewDigitsAsTheStepNeeds) {
  EXPECT_EQ(texts(niceTicks({0.0, 1.0}, Scale::linear, 5)),
            (std::vector<std::string>{"0", "0.2", "0.4", "0.6", "0.8", "1.0"}));
  EXPECT_EQ(texts(niceTicks({-20.0, 20.0}, Scale::linear, 4)),
            (std::vector<std::string>{"-20", "-10", "0", "10", "20"}));
  EXPECT_EQ(tickText(20000.0, 10000.0), "20000");
}

TEST(Ticks, ALogarithmicAxisCountsInDecades) {
  EXPECT_EQ(texts(niceTicks({1.0, 1e6}, Scale::logarithmic, 8)),
            (std::vector<std::string>{"1", "10", "100", "1000", "10000", "100000", "1000000"}));
  const Range range = niceRange({2915.0, 41582.0}, Scale::logarithmic, 5);
  EXPECT_DOUBLE_EQ(range.from, 2000.0);
  EXPECT_DOUBLE_EQ(range.to, 50000.0);
}

}  // namespace palpate::figures
