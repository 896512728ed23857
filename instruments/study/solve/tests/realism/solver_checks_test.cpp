// Richardson's estimate on series whose limit is known, and the checks of the solver within their bars.
#include "solve/realism/solver_checks.h"

#include <gtest/gtest.h>

namespace palpate::lab {
namespace {

const tissue::LayerStack kRib{{{"skin", 2, 150}, {"fat", 4, 10}, {"muscle", 9, 27}}, 0.48};

TEST(SolverChecks, TheOrderOfASeriesIsFound) {
  // 1 + h^2 at h = 0.4, 0.2, 0.1
  EXPECT_NEAR(observedOrder(1.16, 1.04, 1.01).value(), 2.0, 1e-9);
  EXPECT_NEAR(gridConvergence(1.16, 1.04, 1.01), 1.25 * 0.01 / 1.01, 1e-9) << "1.25 times the true error";
}

TEST(SolverChecks, WithoutAnOrderTheLastDifferenceCountsThreeTimes) {
  EXPECT_FALSE(observedOrder(1.0, 1.1, 1.0).has_value()) << "to and fro";
  EXPECT_FALSE(observedOrder(1.0, 1.1, 1.3).has_value()) << "farther and farther";
  EXPECT_FALSE(observedOrder(1.0, 1.0, 1.0).has_value());
  EXPECT_NEAR(gridConvergence(1.0, 1.1, 1.0), 0.3, 1e-9);
}

TEST(SolverChecks, ThePressConverges) {
  const RefinedPress refined = refinePress(kRib, 3.0);
  ASSERT_EQ(refined.force_n.size(), 3u);
  EXPECT_EQ(refined.fineness.back(), 2.0);
  EXPECT_LT(refined.default_error, 2e-3);
  EXPECT_LT(stepError(kRib, 3.0), 1e-5);
  EXPECT_LT(energyError(kRib, 3.0), 1e-3);
}

TEST(SolverChecks, ASmallPressOnADeepBlockIsHertz) {
  const HertzCheck hertz = checkHertz();
  EXPECT_LT(hertz.force_error, 0.008);
  EXPECT_LT(hertz.contact_error, 0.045);
}

}  // namespace
}  // namespace palpate::lab
