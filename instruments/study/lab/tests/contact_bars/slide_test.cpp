// Sliding over the back at up to 500 mm/s: the finger keeps up with the hand, the force is smooth, nothing is
// allocated.
#include <fmt/format.h>

#include "lab/tests/contact_bars/bars.h"

namespace palpate::bars {
namespace {

struct SizeBar {
  std::size_t triangles;
  double max_lag_mm, max_sphere_lag_mm;
};

/// Lag is geometry: 10 mm deep and slipping at mu = 0.44, the anchor is 10.93 mm from the tip; an 8 mm sphere's anchor
/// 12.8 mm. Coarse facets add to the worst case.
constexpr double kLagP99Mm = 11.0;
constexpr double kSphereLagP99Mm = 12.8;
constexpr double kForceStepN = 0.45;

const SizeBar kSizes[] = {{2962, 14.5, 15.7},  {6261, 14.5, 15.7},   {8163, 13.0, 13.5},    {20389, 13.0, 13.5},
                          {41582, 13.0, 13.5}, {200000, 13.0, 13.5}, {1000000, 13.0, 13.5}, {4000000, 13.0, 13.5}};
constexpr bench::Window kSlideWindow{lab::kSlideFromSeconds, lab::kSlideUntilSeconds};

class SlideAtSize : public testing::TestWithParam<SizeBar> {
  void SetUp() override {
    if (GetParam().triangles > 200000 && !heavy()) GTEST_SKIP() << "only with PALPATE_HEAVY=1";
  }
};

TEST_P(SlideAtSize, KeepsLagForceStepAndHeap) {
  bench::ContactWorld world = makeBarWorld(fmt::format("back_{}", GetParam().triangles));

  const bench::ContactFigures point = measure(world, "back_slide", 0.0, kSlideWindow);
  EXPECT_LE(point.lag_mm.p99, kLagP99Mm);
  EXPECT_LE(point.lag_mm.max, GetParam().max_lag_mm);
  EXPECT_LE(point.max_force_step_n, kForceStepN) << "at tick " << point.max_force_step_tick;
  EXPECT_EQ(point.contact_ticks, point.ticks);
  EXPECT_EQ(point.falls.ticks, 0u);
  support::expectNone(point.counts.allocations);

  const bench::ContactFigures sphere = measure(world, "back_slide", 8.0, kSlideWindow);
  EXPECT_LE(sphere.lag_mm.p99, kSphereLagP99Mm);
  EXPECT_LE(sphere.lag_mm.max, GetParam().max_sphere_lag_mm);
  EXPECT_EQ(sphere.contact_ticks, sphere.ticks);
  EXPECT_EQ(sphere.falls.ticks, 0u);
  support::expectNone(sphere.counts.allocations);
}

INSTANTIATE_TEST_SUITE_P(Back, SlideAtSize, testing::ValuesIn(kSizes),
                         [](const auto& bar) { return fmt::to_string(bar.param.triangles); });

TEST(Slide, IsTheSameAtEveryScaleOfTheWorld) {
  bench::ContactWorld real = makeBarWorld("back_8163", 1.0);
  const bench::ContactFigures expected = measure(real, "back_slide", 0.0, kSlideWindow);
  for (const double scale : {0.001, 1000.0}) {
    bench::ContactWorld world = makeBarWorld("back_8163", scale);
    const bench::ContactFigures figures = measure(world, "back_slide", 0.0, kSlideWindow);
    EXPECT_NEAR(figures.lag_mm.max, expected.lag_mm.max, 1e-6) << scale;
    EXPECT_NEAR(figures.peak_force_n, expected.peak_force_n, 1e-6) << scale;
    EXPECT_NEAR(figures.max_force_step_n, expected.max_force_step_n, 1e-6) << scale;
    EXPECT_EQ(figures.friction.slip_ticks, expected.friction.slip_ticks) << scale;
  }
}

TEST(Slide, IsTheSameToTheLastBitWhenRepeated) {
  bench::ContactWorld world = makeBarWorld("back_8163");
  for (const double radius_mm : {0.0, 8.0}) {
    EXPECT_EQ(measure(world, "back_slide", radius_mm).hash, measure(world, "back_slide", radius_mm).hash);
  }
}

TEST(Slide, AllocatesNothingInAHundredThousandTicks) {
  bench::ContactWorld world = makeBarWorld("back_8163");
  std::uint64_t ticks = 0;
  for (const char* path : {"back_slide", "back_jump1mm", "back_jump5mm", "back_jump20mm", "back_stab2mps"}) {
    for (const double radius_mm : {0.0, 8.0}) {
      const bench::ContactFigures figures = measure(world, path, radius_mm);
      ticks += figures.ticks;
      support::expectNone(figures.counts.allocations, path);
    }
  }
  EXPECT_GE(ticks, 100000u);
}

}  // namespace
}  // namespace palpate::bars
