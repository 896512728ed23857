#include "palpate/tissue/profile.h"

#include <gtest/gtest.h>

#include "support/golden.h"

namespace palpate::tissue {

using test::golden;
using test::goldenRows;

TEST(HalfGaussian, IsTheCurveOfTheStoredTable) {
  const auto data = golden("gaussian_table");
  const int n = data["n"];
  for (int i = 0; i < n; ++i) {
    const double q = static_cast<double>(i) / (n - 1);
    EXPECT_NEAR(halfGaussian(q), data["table"][static_cast<std::size_t>(i)], 1e-12);
  }
  for (const auto& level : data["q_of_level"]) EXPECT_NEAR(halfGaussian(level["q"]), level["level"], 1e-12);
}

TEST(Profile, MatchesTheContinuousReference) {
  for (const auto& c : goldenRows("gaussian_table", "lookup")) EXPECT_NEAR(profile(c["q"]), c["c0"], 1e-12) << c;
}

TEST(Profile, RunsFromOneToZeroWithoutAStep) {
  EXPECT_DOUBLE_EQ(kProfileRim, halfGaussian(1.0));
  EXPECT_DOUBLE_EQ(profile(0.0), 1.0);
  EXPECT_NEAR(profile(1.0 - 1e-9), 0.0, 1e-9);
  EXPECT_EQ(profile(1.0), 0.0);
  EXPECT_EQ(profile(NAN), 0.0);
  for (double q = 0.0; q < 1.0; q += 0.01) EXPECT_GT(profile(q), profile(q + 0.01));
}

}  // namespace palpate::tissue
