// What safety costs, on the default scene of `palpate simulate`.
#include "lab/runs/safety_run.h"

#include <gtest/gtest.h>

#include "support/timed.h"

namespace palpate::bench {
namespace {

TEST(SafetyRun, CostsAShareOfATick) {
  scene::Scene scene;
  scene.fingers.resize(1);
  const auto world = scene::build(scene);
  const SafetyCost cost = measureSafety(*world, device::pathsOf(*world), 0.3);
  EXPECT_GT(cost.blocks, 20u);
  EXPECT_GT(cost.safety_us, 0.0);
  EXPECT_GT(cost.tick_us, cost.safety_us);
  if (support::timesAreJudged()) {
    EXPECT_LE(cost.safety_us, 0.10) << "the bar of docs/reference/benchmarks.md";
  }
}

}  // namespace
}  // namespace palpate::bench
