// Broken devices and absurd settings: a finger may give up, but it answers with finite, bounded forces and recovers.
#include <array>
#include <limits>

#include "lab/tests/contact_bars/bars.h"
#include "palpate/base/random.h"

namespace palpate::bars {
namespace {

/// A tip as a broken device may send it: mostly a walk in the skin, now and then nonsense.
Vec3 hostileTip(const Vec3& walk, Random& random) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr std::array<double, 8> kNonsense{
      std::numeric_limits<double>::quiet_NaN(), kInfinity, -kInfinity, 1e308, -1e308, 5e-324, -0.0, 1e20};
  if (random.below(10) != 0) return walk;
  Vec3 tip = walk;
  tip[static_cast<int>(random.below(3))] = kNonsense[random.below(kNonsense.size())];
  return tip;
}

std::vector<Vec3> hostileTips(std::size_t ticks, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> tips = lab::backJumps(3.0, seed).tip_mm;
  tips.resize(ticks);
  for (Vec3& tip : tips) tip = hostileTip(tip, random);
  return tips;
}

TEST(HostileTips, GiveFiniteBoundedForces) {
  const bench::ContactWorld world = makeBarWorld("back_2962");
  for (const double radius_mm : radiiMm()) {
    const contact::FingerSettings finger = makeBarFinger(radius_mm);
    const bench::FingerRun run = bench::runFinger(world.surface, finger, hostileTips(20000, 3));
    const lab::InvariantReport invariants =
        lab::checkInvariants(world.side.mesh(), finger, world.stiffness_n_per_mm, run.outputs);
    EXPECT_TRUE(invariants.clean()) << "radius " << radius_mm << ": " << invariants.text();
  }
}

TEST(HostileTips, DoNotStopTheFingerFromFeelingAgain) {
  const bench::ContactWorld world = makeBarWorld("back_2962");
  const Vec3 above(175, 200, lab::backHeight(175, 200) + 5), below = above - Vec3(0, 0, 10);
  for (const double radius_mm : radiiMm()) {
    contact::FingerState state;
    for (const Vec3& tip : hostileTips(2000, 4)) contact::step(world.surface, makeBarFinger(radius_mm), state, tip);
    const Vec3 far = above + Vec3(0, 0, 500);
    for (int i = 0; i < 5; ++i) contact::step(world.surface, makeBarFinger(radius_mm), state, far);
    contact::step(world.surface, makeBarFinger(radius_mm), state, above + Vec3(0, 0, 10));
    EXPECT_FALSE(contact::step(world.surface, makeBarFinger(radius_mm), state, below).force.isZero(0.0)) << radius_mm;
  }
}

TEST(AbsurdSettings, AreSurvived) {
  const bench::ContactWorld world = makeBarWorld("back_2962");
  std::vector<Vec3> tips = lab::backJumps(5.0, 5).tip_mm;
  tips.resize(3000);
  std::vector<contact::FingerSettings> absurd(6, makeBarFinger(0.0));
  absurd[0].stiffness_ratio = 0.0;
  absurd[1].mu_static = absurd[1].mu_dynamic = 1e6;
  absurd[2].max_depth_mm = 1e-9;
  absurd[3].catch_up_mm_per_s = 0.0;
  absurd[4].tick_s = 10.0;
  absurd[5].stiffness_ratio = 1e6;
  for (std::size_t i = 0; i < absurd.size(); ++i) {
    const bench::FingerRun run = bench::runFinger(world.surface, absurd[i], tips);
    const lab::InvariantReport invariants =
        lab::checkInvariants(world.side.mesh(), absurd[i], world.stiffness_n_per_mm, run.outputs);
    EXPECT_TRUE(invariants.clean()) << "setting " << i << ": " << invariants.text();
  }
}

}  // namespace
}  // namespace palpate::bars
