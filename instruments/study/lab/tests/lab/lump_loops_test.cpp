// Lumps give no energy away: the measurement itself, small.
#include "lab/loops/lump_loops.h"

#include <gtest/gtest.h>

#include "lab/loops/loop_trials.h"
#include "lab/workloads/random_lumps.h"
#include "palpate/tissue/force_law.h"

namespace palpate::lab {
namespace {

TEST(LumpLoops, ClosedPathsCostNothingAndTheErrorFallsWithTheSquare) {
  const ClosedPathsFigures figures = measureClosedPaths({.paths = 60, .seed = 4, .threads = 1});
  EXPECT_EQ(figures.paths, 60u);
  EXPECT_LT(figures.worstShare(), 1e-5);
  EXPECT_GT(figures.stored_n_mm, 0.0);
  ASSERT_EQ(figures.by_steps.size(), 3u);
  EXPECT_GT(figures.by_steps[1].mean_share, 3.0 * figures.by_steps[0].mean_share);
  EXPECT_GT(figures.by_steps[2].mean_share, 3.0 * figures.by_steps[1].mean_share);
}

TEST(LumpLoops, AreTheSameForTheSameSeedOnAnyNumberOfThreads) {
  const ClosedPathsFigures one = measureClosedPaths({.paths = 120, .step_mm = 0.1, .seed = 9, .threads = 1});
  const ClosedPathsFigures two = measureClosedPaths({.paths = 120, .step_mm = 0.1, .seed = 9, .threads = 2});
  EXPECT_EQ(one.worst_work_n_mm, two.worst_work_n_mm);
  EXPECT_EQ(one.ticks, two.ticks);
  EXPECT_NE(one.ticks, measureClosedPaths({.paths = 120, .step_mm = 0.1, .seed = 8, .threads = 2}).ticks);
}

TEST(LumpLoops, HandsGetBackNoMoreFromMobileLumpsThanIsStored) {
  const HeldLumpsFigures figures = measureHeldLumps({.paths = 12, .seconds = 2.0, .seed = 3, .threads = 1});
  EXPECT_EQ(figures.paths, 12u);
  EXPECT_EQ(figures.with_two_fingers, 6u);
  EXPECT_GE(figures.felt, 6u) << "lumps move in most of them";
  EXPECT_LT(figures.given_back_n_mm, 1e-5);
  EXPECT_GT(figures.lost_n_mm, 0.01);
  EXPECT_EQ(figures.oscillating, 0u);
}

TEST(RandomLumps, AreNeverSteeperThanTissueMayBe) {
  constexpr double kSkin = 0.5;
  Random random(6);
  for (int i = 0; i < 12; ++i) {
    const contact::Lump lump = randomLump(randomLumpPlace(random), Vec3::Zero(), Vec3::UnitZ(), kSkin, random);
    EXPECT_LE(lump.energy.steepest().depth, tissue::kStiffestTissue - kSkin + 1e-9);
    EXPECT_LE(lump.energy.steepest().rho, tissue::kStiffestTissue + 1e-9);
  }
  const contact::Lump stiffest = stiffestLump(Vec3::Zero(), Vec3::UnitZ(), kSkin);
  const tissue::LumpSteepness steepest = stiffest.energy.steepest();
  EXPECT_NEAR(std::max(steepest.depth / (tissue::kStiffestTissue - kSkin), steepest.rho / tissue::kStiffestTissue), 1.0,
              1e-9);
}

}  // namespace
}  // namespace palpate::lab
