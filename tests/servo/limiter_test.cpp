#include "palpate/servo/limiter.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "palpate/base/random.h"

namespace palpate::servo {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

LimiterSettings withoutRamp() {
  LimiterSettings settings;
  settings.safety.ramp_s = 0.0;
  return settings;
}

/// One tick of a finger at `tip` whose contact computes `force`.
Vec3 tick(const LimiterSettings& settings, LimiterState& state, const Vec3& tip, const Vec3& force) {
  guardTip(settings, state, tip);
  return limitForce(settings, state, force);
}

TEST(Limiter, LetsOrdinaryContactThroughBitByBit) {
  const LimiterSettings settings = withoutRamp();
  LimiterState state;
  double depth = 0.0;
  tick(settings, state, Vec3(0, 0, 0), Vec3::Zero());
  for (int i = 1; i <= 100; ++i) {
    depth = 0.05 * i;
    const Vec3 force(0, 0, 0.5 * depth);
    EXPECT_EQ(tick(settings, state, Vec3(0, 0, -depth), force), force);
    EXPECT_EQ(state.status, 0u);
  }
}

TEST(Limiter, RampsUpAfterTheStart) {
  LimiterSettings settings;
  settings.safety.ramp_s = 0.01;
  LimiterState state;
  for (int i = 1; i < 10; ++i) {
    EXPECT_NEAR(tick(settings, state, Vec3::Zero(), Vec3(0, 0, 0.1)).z(), 0.01 * i, 1e-12);
    EXPECT_EQ(state.status, kRamping);
  }
  tick(settings, state, Vec3::Zero(), Vec3(0, 0, 0.1));
  EXPECT_EQ(tick(settings, state, Vec3::Zero(), Vec3(0, 0, 0.1)).z(), 0.1);
  EXPECT_EQ(state.status, 0u);
}

TEST(Limiter, NeverSendsMoreThanTheContactAtTheEndOfARamp) {
  LimiterSettings settings;
  settings.safety.ramp_s = 0.00102;  // a little more than one tick
  LimiterState state;
  for (int i = 0; i < 4; ++i) EXPECT_LE(tick(settings, state, Vec3::Zero(), Vec3(0, 0, 0.01)).z(), 0.01);
  EXPECT_DOUBLE_EQ(state.force.z(), 0.01);
}

TEST(Limiter, ShortensToTheNominalForceAndKeepsTheDirection) {
  const LimiterSettings settings = withoutRamp();
  LimiterState state;
  Vec3 sent;
  for (int i = 0; i < 2000; ++i) sent = tick(settings, state, Vec3::Zero(), Vec3(30, 0, 40));
  EXPECT_NEAR(sent.norm(), 3.3, 1e-12);
  EXPECT_LT((sent.normalized() - Vec3(0.6, 0, 0.8)).norm(), 1e-12);
  EXPECT_TRUE(state.status & kClamped);
}

TEST(Limiter, SpreadsAJumpOfTheContactOverTicks) {
  const LimiterSettings settings = withoutRamp();
  LimiterState state;
  tick(settings, state, Vec3::Zero(), Vec3::Zero());
  const double step_at_rest = settings.stiffness_n_per_mm * settings.safety.slew_mm;
  EXPECT_DOUBLE_EQ(tick(settings, state, Vec3::Zero(), Vec3(0, 0, 3)).z(), step_at_rest);
  EXPECT_EQ(state.status, kSlewLimited);
  EXPECT_DOUBLE_EQ(tick(settings, state, Vec3(0.3, 0, 0), Vec3(0, 0, 3)).z(), 2 * step_at_rest + 0.5 * 2.0 * 0.3);
}

TEST(Limiter, RunsDownByTheSameLawAfterRelease) {
  const LimiterSettings settings = withoutRamp();
  LimiterState state;
  for (int i = 0; i < 100; ++i) tick(settings, state, Vec3::Zero(), Vec3(0, 0, 2));
  double last = state.force.z();
  ASSERT_DOUBLE_EQ(last, 2.0);
  int ticks = 0;
  for (; last > 0.0; ++ticks) {
    const double now = tick(settings, state, Vec3::Zero(), Vec3::Zero()).z();
    EXPECT_LE(last - now, 0.05 + 1e-12);
    last = now;
  }
  EXPECT_EQ(ticks, 40);
}

TEST(Limiter, UsesTheLastGoodTipWhenTheDeviceGivesNoNumber) {
  const LimiterSettings settings = withoutRamp();
  LimiterState state;
  guardTip(settings, state, Vec3(1, 2, 3));
  limitForce(settings, state, Vec3::Zero());
  EXPECT_EQ(guardTip(settings, state, Vec3(kNan, 0, 0)), Vec3(1, 2, 3));
  EXPECT_TRUE(state.status & kTipNotFinite);
}

TEST(Limiter, RampsAgainAfterATipFasterThanAHand) {
  LimiterSettings settings;
  LimiterState state;
  for (int i = 0; i < 1000; ++i) tick(settings, state, Vec3::Zero(), Vec3(0, 0, 1));
  ASSERT_DOUBLE_EQ(state.force.z(), 1.0);
  const double after = tick(settings, state, Vec3(500, 0, 0), Vec3(0, 0, 1)).z();
  EXPECT_TRUE(state.status & kTipJumped);
  EXPECT_NEAR(after, 1.0 - 0.05, 1e-12) << "a jump must not be a licence to change the force at once";
}

/// Energy that a hand gains (N mm) which presses 10 mm into a spring of one stiffness, leaves it by another, and rests
/// in free air.
double energyOfAStroke(const LimiterSettings& settings, LimiterState& state, double down_n_per_mm, double up_n_per_mm) {
  double gained = 0.0;
  for (int i = 0; i <= 2000; ++i) {
    const double depth = i <= 1000 ? 0.01 * i : 0.01 * (2000 - i);
    const double stiffness = i <= 1000 ? down_n_per_mm : up_n_per_mm;
    gained += state.force.z() * (-depth - state.tip.z());
    tick(settings, state, Vec3(0, 0, -depth), Vec3(0, 0, stiffness * depth));
  }
  for (int i = 0; i < 100; ++i) tick(settings, state, Vec3::Zero(), Vec3::Zero());
  return gained;
}

LimiterSettings ofStrokes(bool passivity) {
  LimiterSettings settings = withoutRamp();
  settings.safety.nominal_force_n = 100.0;
  settings.safety.passivity = passivity;
  return settings;
}

TEST(Limiter, TakesPushFromASpringThatGivesBackMoreThanItTook) {
  const auto energy_gained = [](bool passivity) {
    LimiterState state;
    double gained = 0.0;  // an engine of 0.15 d^2 a stroke
    for (int stroke = 0; stroke < 5; ++stroke) gained += energyOfAStroke(ofStrokes(passivity), state, 0.2, 0.5);
    return gained / 5.0;
  };
  EXPECT_GT(energy_gained(false), 10.0);
  EXPECT_LT(energy_gained(true), 2.5) << "allowance of 1 N mm, and one tick's delay";
}

TEST(Limiter, ForgetsInFreeAirWhatATouchTook) {
  LimiterState state;
  EXPECT_LT(energyOfAStroke(ofStrokes(true), state, 0.5, 0.2), -10.0) << "a brake";
  EXPECT_LT(energyOfAStroke(ofStrokes(true), state, 0.2, 0.5), 2.5) << "a credit does not pay for the next touch";
}

RC_GTEST_PROP(Limiter, IsAlwaysFiniteBoundedAndGradual, (std::uint64_t seed)) {
  Random random(seed);
  LimiterSettings settings;
  settings.safety.ramp_s = random.uniform(0.0, 0.1);
  LimiterState state;
  const auto wild = [&]() -> double {
    switch (random.below(8)) {
      case 0:
        return kNan;
      case 1:
        return std::numeric_limits<double>::infinity();
      case 2:
        return 1e308;
      default:
        return random.uniform(-20.0, 20.0);
    }
  };
  for (int i = 0; i < 500; ++i) {
    const Vec3 before = state.force;
    const Vec3 sent = tick(settings, state, Vec3(wild(), wild(), wild()), Vec3(wild(), wild(), wild()));
    RC_ASSERT(sent.allFinite());
    RC_ASSERT(sent.norm() <= 3.3 * (1 + 1e-12));
    RC_ASSERT((sent - before).norm() <= 0.5 * (2.0 * state.motion.norm() + 0.1) * (1 + 1e-9));
  }
}

}  // namespace
}  // namespace palpate::servo
