// The hunt itself: the same for the same seed, whatever the threads; what fails can be made again, made short and kept.
#include "lab/hunt/hunt.h"

#include <gtest/gtest.h>

#include "lab/hunt/kept_case.h"
#include "lab/workloads/heldout_meshes.h"
#include "palpate/base/error.h"
#include "support/temporary_folder.h"

namespace palpate::lab {
namespace {

HuntPlan smallPlan() {
  HuntPlan plan;
  plan.ticks = 30000;
  plan.bodies = 4;
  plan.seed = 5;
  return plan;
}

NamedBody ballBody() { return {"ball", bumpyBallMesh(60, 0.05, 5, 3)}; }

TEST(Hunt, IsTheSameOnAnyNumberOfThreads) {
  HuntPlan plan = smallPlan();
  plan.threads = 1;
  const HuntResult one = hunt(plan);
  plan.threads = 3;
  const HuntResult three = hunt(plan);
  EXPECT_EQ(one.ticks, 30000u);
  EXPECT_EQ(one.bodies, 4u);
  EXPECT_EQ(one.ticks, three.ticks);
  EXPECT_EQ(one.touching_ticks, three.touching_ticks);
  EXPECT_EQ(one.fault_ticks, three.fault_ticks);
  ASSERT_EQ(one.failing.size(), three.failing.size());
  for (std::size_t i = 0; i < one.failing.size(); ++i) {
    EXPECT_EQ(one.failing[i].seed, three.failing[i].seed);
    EXPECT_EQ(one.failing[i].finding.measured, three.failing[i].finding.measured);
  }
}

TEST(Hunt, TouchesMuchAndDiffersBySeed) {
  HuntPlan plan = smallPlan();
  const HuntResult one = hunt(plan);
  EXPECT_GT(one.touching_ticks, one.ticks / 3);
  plan.seed = 6;
  EXPECT_NE(hunt(plan).touching_ticks, one.touching_ticks);
}

TEST(Hunt, TakesBodiesFromOutsideAtAnyScale) {
  HuntPlan plan = smallPlan();
  plan.meshes = {ballBody()};
  plan.generated = false;
  plan.radii_mm = {0.0};
  const HuntResult real = hunt(plan);
  EXPECT_EQ(real.bodies, 1u);
  EXPECT_EQ(real.ticks, 30000u);
  plan.scale = 1024.0;  // a power of two: the same digits
  EXPECT_EQ(hunt(plan).touching_ticks, real.touching_ticks);
}

TEST(Hunt, WithLumpsIsTheSameForTheSameSeedAndFindsNothing) {
  HuntPlan plan = smallPlan();
  plan.ticks = 12000;
  plan.bodies = 2;
  plan.lumps = 12;
  const HuntResult one = hunt(plan);
  EXPECT_EQ(one.fault_ticks, (std::array<std::size_t, kFaults>{}));
  EXPECT_EQ(one.touching_ticks, hunt(plan).touching_ticks);
  plan.lumps = 0;
  EXPECT_EQ(one.touching_ticks, hunt(plan).touching_ticks) << "lumps change forces, not contacts";
  plan.lumps = 1000;
  EXPECT_THROW(hunt(plan), Error);
}

TEST(Hunt, RefusesWhatCannotBeHunted) {
  HuntPlan plan = smallPlan();
  plan.generated = false;
  EXPECT_THROW(hunt(plan), Error);
  plan = smallPlan();
  plan.radii_mm.clear();
  EXPECT_THROW(hunt(plan), Error);
  plan = smallPlan();
  plan.meshes = {{"flat.obj", {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}}}};
  try {
    hunt(plan);
    FAIL() << "a mesh without a triangle that can be felt was hunted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("flat.obj"), std::string::npos) << error.what();
  }
  EXPECT_THROW(huntedMesh(smallPlan(), "nose#1"), Error);
}

/// Fails at the first tip with x = 77 after one with x = 20, as a finger does that was led astray.
std::optional<std::size_t> fails(std::span<const Vec3> tips) {
  bool astray = false;
  for (std::size_t k = 0; k < tips.size(); ++k) {
    astray = astray || tips[k].x() == 20.0;
    if (astray && tips[k].x() == 77.0) return k;
  }
  return std::nullopt;
}

TEST(Minimise, KeepsWhatTheFaultNeedsAndNothingElse) {
  std::vector<Vec3> tips;
  for (int k = 0; k < 100; ++k) tips.emplace_back(k, 0, 0);
  EXPECT_EQ(minimised(tips, fails), (std::vector<Vec3>{{20, 0, 0}, {77, 0, 0}}));
  tips[77].x() = 76.0;
  EXPECT_EQ(minimised(tips, fails), tips) << "without the fault it stays";
}

TEST(Minimise, StopsWhenItHasTriedEnough) {
  std::vector<Vec3> tips;
  for (int k = 0; k < 100; ++k) tips.emplace_back(k, 0, 0);
  std::size_t tried = 0;
  const auto counting = [&](std::span<const Vec3> path) {
    tried += path.size();
    return fails(path);
  };
  EXPECT_TRUE(fails(minimised(tips, counting, 250)));
  EXPECT_LE(tried, 250u);
}

TEST(Hunt, FailingPathsAreMadeAgainFromBodySeedAndRadius) {
  const HuntPlan plan = smallPlan();
  for (const FailingPath& path : hunt(plan).failing) {  // none, where the finger is faultless
    HuntWorld world = buildHuntWorld(huntedMesh(plan, path.body));
    std::vector<Vec3> tips = huntedTips(world.body, path.seed, path.radius_mm, plan.scale);
    tips.resize(std::min(tips.size(), path.ticks));
    const HuntReport again = huntAlong(world, huntedFinger(path.radius_mm, plan.scale), tips);
    EXPECT_EQ(again.of(path.fault).first_tick, path.finding.first_tick);
    EXPECT_EQ(again.of(path.fault).measured, path.finding.measured);
  }
}

TEST(KeptCase, ComesBackBitByBit) {
  const support::TemporaryFolder folder;
  KeptCase kept;
  kept.body = "coarse#7";
  kept.seed = 4242;
  kept.radius_mm = 0.5;
  kept.scale = 0.001;
  kept.fault = Fault::missed_contact;
  kept.finding = {1, 2, "depth, mm", 0.1 + 0.2, 1e-17};
  kept.tips = {{0.1, 1.0 / 3.0, -7e-9}, {1e-300, 2, 3}, {4, 5, 6}};
  HuntPlan plan;
  plan.scale = kept.scale;
  kept.mesh = huntedMesh(plan, kept.body);
  EXPECT_EQ(caseFolderName(kept), "missed_contact_coarse_7_r0.5_s4242");
  writeCase(folder / "case", kept);
  const KeptCase read = readCase(folder / "case");
  EXPECT_EQ(read.body, kept.body);
  EXPECT_EQ(read.seed, kept.seed);
  EXPECT_EQ(read.radius_mm, kept.radius_mm);
  EXPECT_EQ(read.scale, kept.scale);
  EXPECT_EQ(read.fault, kept.fault);
  EXPECT_EQ(read.finding.measured, kept.finding.measured);
  EXPECT_EQ(read.tips, kept.tips);
  EXPECT_EQ(read.mesh.positions, kept.mesh.positions);
  EXPECT_EQ(replay(read).ticks, 3u);
  std::filesystem::remove(folder / "case/note.txt");  // then it is a scene as anybody may have written it
  const KeptCase scene = readCase(folder / "case");
  EXPECT_EQ(scene.tips, kept.tips);
  EXPECT_EQ(scene.mesh.positions, kept.mesh.positions);
  EXPECT_DOUBLE_EQ(scene.radius_mm, 0.5 * 0.001);
  std::filesystem::remove(folder / "case/path.csv");
  EXPECT_THROW(readCase(folder / "case"), Error);
}

}  // namespace
}  // namespace palpate::lab
