// What safety costs, on the scene that `palpate simulate` takes by itself. The bar of a quiet core is 0.10 us
// (docs/benchmarks.md); here compilers may run beside it.
#include "bench/runs/safety_run.h"

#include <gtest/gtest.h>

namespace palpate::bench {
namespace {

TEST(SafetyRun, CostsAShareOfATick) {
  scene::Scene scene;
  scene.fingers.resize(1);
  const auto world = scene::build(scene);
  const SafetyCost cost = measureSafety(*world, device::pathsOf(*world), 0.3);
  EXPECT_GT(cost.blocks, 20u);
  EXPECT_GT(cost.safety_us, 0.0);
  EXPECT_LE(cost.safety_us, 0.5);
  EXPECT_GT(cost.tick_us, cost.safety_us);
}

}  // namespace
}  // namespace palpate::bench
