// What `palpate study bench batch` measures is what it says: the same ticks on any number of threads.
#include "lab/runs/batch_run.h"

#include <gtest/gtest.h>

#include "lab/counters/thread_counts.h"
#include "palpate/base/error.h"
#include "palpate/device/finger_path.h"
#include "palpate/engine/fingers.h"

namespace palpate::bench {
namespace {

std::shared_ptr<const scene::World> torso() {
  scene::Scene scene;
  scene.body.kind = scene::BodyKind::torso;
  scene.fingers.resize(1);
  return scene::build(scene);
}

TEST(BatchRun, FeelsTheSameOnAnyNumberOfThreadsAndAllocatesNothing) {
  const auto world = torso();
  const auto paths = device::pathsOf(*world);
  const auto finger = engine::fingerSettings(world->scene).front();
  const BatchSettings settings{.fingers = 7, .action_ticks = 10, .threads = 3, .seconds = 0.01};
  const BatchFigures figures = measureBatch(*world, finger, *paths.tips.front(), settings);
  EXPECT_EQ(figures.different, 0u);
  EXPECT_EQ(figures.pass_ticks % 70, 0u);
  EXPECT_GT(figures.touching, 0.4) << "a finger that is put down in the skin feels nothing";
  EXPECT_GT(figures.native_ticks_per_s, 0.0);
  EXPECT_GT(figures.batch.scaling(), 0.0);
  EXPECT_GT(figures.rollout.one_thread_ticks_per_s, 0.0);
  if (!lab::kCountsCalls) return;
  EXPECT_EQ(figures.allocations, 0u);
  EXPECT_EQ(figures.locks, 0u);
}

TEST(BatchRun, RefusesSettingsThatMakeNoSense) {
  const auto world = torso();
  contact::FingerSettings finger;
  finger.tick_s = -1.0;
  EXPECT_THROW(measureBatch(*world, finger, std::vector<Vec3>{Vec3::Zero()}, {}), Error);
  EXPECT_THROW(measureBatch(*world, {}, {}, {}), Error);
}

}  // namespace
}  // namespace palpate::bench
