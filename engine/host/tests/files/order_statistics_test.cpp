#include "palpate/base/order_statistics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palpate {

TEST(OrderStatistics, MedianOfAnEvenNumberIsTheMeanOfTheTwoInTheMiddle) {
  EXPECT_EQ(medianOf({3.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(medianOf({4.0, 1.0, 3.0, 2.0}), 2.5);
  EXPECT_EQ(medianOf({}), 0.0);
}

TEST(OrderStatistics, UpperMedianIsOneOfTheValues) {
  EXPECT_EQ(upperMedianOf(std::vector<double>{4.0, 1.0, 3.0, 2.0}), 3.0);
  EXPECT_EQ(upperMedianOf(std::vector<float>{}), 0.0f);
}

TEST(OrderStatistics, QuantilesLieLinearlyBetweenRanks) {
  EXPECT_DOUBLE_EQ(quantileOf({10.0, 0.0}, 0.25), 2.5);
  EXPECT_DOUBLE_EQ(quantileOf({4.0, 1.0, 3.0, 2.0, 5.0}, 0.5), 3.0);
  EXPECT_DOUBLE_EQ(quantileOf({4.0, 1.0, 3.0, 2.0, 5.0}, 1.0), 5.0);
  EXPECT_DOUBLE_EQ(quantileOf({7.0}, 0.95), 7.0);
  EXPECT_TRUE(std::isnan(quantileOf({}, 0.5)));
}

}  // namespace palpate
