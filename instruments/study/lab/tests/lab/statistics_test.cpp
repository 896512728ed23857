#include "lab/counters/statistics.h"

#include <gtest/gtest.h>

#include <numeric>

namespace palpate::lab {
namespace {

/// last, ..., 2, 1
std::vector<double> countdown(int last) {
  std::vector<double> numbers(static_cast<std::size_t>(last));
  std::iota(numbers.rbegin(), numbers.rend(), 1.0);
  return numbers;
}

TEST(Percentiles, AreTheSamplesOfThatRank) {
  const Percentiles of_thousand = computePercentiles(countdown(1000));
  EXPECT_EQ(of_thousand.p50, 500.0);
  EXPECT_EQ(of_thousand.p99, 990.0);
  EXPECT_EQ(of_thousand.p99_9, 999.0);
  EXPECT_EQ(of_thousand.max, 1000.0);
}

TEST(Percentiles, OfFewSamplesAreSamplesToo) {
  const Percentiles of_three = computePercentiles({7.0, 1.0, 4.0});
  EXPECT_EQ(of_three.p50, 4.0);
  EXPECT_EQ(of_three.p99, 7.0);
  EXPECT_EQ(computePercentiles({2.5}).p50, 2.5);
}

TEST(Percentiles, OfNoSamplesAreZero) { EXPECT_EQ(computePercentiles({}).max, 0.0); }

}  // namespace
}  // namespace palpate::lab
