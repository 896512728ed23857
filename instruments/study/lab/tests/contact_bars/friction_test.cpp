// Coulomb friction as set, at any speed: 0.46 to break away, 0.44 while slipping.
#include <fmt/format.h>

#include "lab/tests/contact_bars/bars.h"

namespace palpate::bars {
namespace {

struct FrictionBar {
  int mm_per_second;
  double scale, radius_mm;
};

class FlatFriction : public testing::TestWithParam<FrictionBar> {};

TEST_P(FlatFriction, HasItsCoefficients) {
  const auto& [speed, scale, radius_mm] = GetParam();
  bench::ContactWorld world = makeBarWorld("flat100", scale);
  const bench::FrictionFigures friction = measure(world, fmt::format("flat_fric_{}", speed), radius_mm).friction;
  EXPECT_GT(friction.slip_ticks, 50u);
  EXPECT_NEAR(friction.kinetic, 0.44, 1e-4);
  EXPECT_NEAR(friction.kinetic_min, 0.44, 1e-4);
  EXPECT_NEAR(friction.kinetic_max, 0.44, 1e-4);
  EXPECT_LE(friction.static_peak, 0.46 + 1e-6);
  // A tick at 20 mm/s changes the ratio by 0.004, so the last one before slipping is at least that near.
  if (speed == 20) {
    EXPECT_GE(friction.static_peak, 0.455);
  }
}

std::vector<FrictionBar> everyBar() {
  std::vector<FrictionBar> bars;
  for (const int speed : {20, 50, 100, 200, 500}) {
    for (const double scale : {0.001, 1.0, 1000.0}) {
      for (const double radius_mm : {0.0, 5.0}) bars.push_back({speed, scale, radius_mm});
    }
  }
  return bars;
}

INSTANTIATE_TEST_SUITE_P(Bars, FlatFriction, testing::ValuesIn(everyBar()), [](const auto& bar) {
  return testName(
      fmt::format("{}_mm_per_s_scale_{}_radius_{}", bar.param.mm_per_second, bar.param.scale, bar.param.radius_mm));
});

TEST(Friction, HoldsForOtherCoefficientsAndStiffnessRatios) {
  bench::ContactWorld world = makeBarWorld("flat100");
  for (const double ratio : {0.23, 1.0, 2.0}) {
    contact::FingerSettings finger = makeBarFinger(0.0);
    finger.stiffness_ratio = ratio;
    finger.mu_static = 0.8;
    finger.mu_dynamic = 0.3;
    const bench::FrictionFigures friction =
        bench::measureContact(world, lab::workloadPath("flat_fric_50"), finger).friction;
    EXPECT_NEAR(friction.kinetic, 0.3, 1e-4) << ratio;
    EXPECT_LE(friction.static_peak, 0.8 + 1e-6) << ratio;
  }
}

TEST(Friction, IsNoneWithoutCoefficients) {
  bench::ContactWorld world = makeBarWorld("flat100");
  contact::FingerSettings finger = makeBarFinger(0.0);
  finger.mu_static = finger.mu_dynamic = 0.0;
  const bench::FrictionFigures friction =
      bench::measureContact(world, lab::workloadPath("flat_fric_50"), finger).friction;
  EXPECT_LE(friction.kinetic_max, 1e-9);
  EXPECT_LE(friction.static_peak, 1e-9);
}

}  // namespace
}  // namespace palpate::bars
