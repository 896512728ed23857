#include "palpate/servo/limiter.h"
#include "palpate/base/error.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "lab/counters/thread_counts.h"
#include "palpate/base/error.h"
#include "palpate/base/random.h"
#include "palpate/servo/device_limits.h"

namespace palpate::servo {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

const tissue::ForceLaw kHooke;

/// A contact that pushes out of a skin in z = 0 with this force.
contact::FingerOutput makeContact(const Vec3& tip, const Vec3& force) {
  contact::FingerOutput contact;
  contact.tip = tip;
  contact.force = force;
  contact.normal = Vec3::UnitZ();
  contact.depth_mm = std::max(0.0, -tip.z());
  contact.touch = contact.depth_mm > 0.0 ? contact::Touch::stick : contact::Touch::free;
  return contact;
}

/// A finger that moves over a spring below z = 0, tick after tick.
struct Finger {
  LimiterSettings settings;
  LimiterState state;
  double stiffness_n_per_mm = 0.5;
  std::uint64_t next = 0;

  Finger() { state.closes_loop = false; }  // nothing that it sends moves it
  Vec3 tick(const Vec3& tip, const Vec3& force, double age_ticks = 0.0) {
    guardTip(settings, state, {.tip = tip, .tick = next++, .age_ticks = age_ticks});
    return limitForce(settings, state, makeContact(tip, force), kHooke);
  }
  Vec3 at(double z) { return tick({0, 0, z}, {0, 0, std::max(0.0, -z) * stiffness_n_per_mm}); }
};

TEST(Limiter, LetsOrdinaryContactThroughBitByBit) {
  Finger finger;
  finger.at(0.1);
  for (int i = 1; i <= 60; ++i) {
    const double depth = 0.1 * i;
    EXPECT_EQ(finger.at(-depth), Vec3(0, 0, 0.5 * depth));
    EXPECT_EQ(finger.state.status, 0u);
  }
}

TEST(Limiter, ShortensToTheLargestForceAndKeepsTheDirection) {
  Finger finger;
  finger.at(0.1);
  for (double f = 0.0; f < 1.0; f += 0.01) finger.tick({0, 0, -1}, f * Vec3(30, 0, 40));
  EXPECT_NEAR(finger.state.force.norm(), 3.3, 1e-12);
  EXPECT_LT((finger.state.force.normalized() - Vec3(0.6, 0, 0.8)).norm(), 1e-12);
  EXPECT_TRUE(finger.state.status & kClamped);
}

TEST(Limiter, SendsNothingUntilATipThatStartsInsideHasBeenOutside) {
  Finger finger;
  for (int i = 0; i < 1000; ++i) EXPECT_TRUE(finger.at(-4.0).isZero());
  EXPECT_EQ(finger.state.status, kHeldBack);
  EXPECT_EQ(finger.state.counts[9], 1000u);
  finger.at(0.5);
  finger.at(0.01);
  finger.at(0.01);
  EXPECT_EQ(finger.at(-0.01), Vec3(0, 0, 0.005));
}

TEST(Limiter, RampsWhereTheSceneWantsARampInstead) {
  Finger finger;
  finger.settings.start = scene::StartRule::ramp;
  finger.settings.ramp_s = 0.01;
  for (int i = 1; i < 10; ++i) {
    EXPECT_NEAR(finger.at(-1.0).z(), 0.05 * i, 1e-12);
    EXPECT_EQ(finger.state.status, kRamping);
  }
  finger.at(-1.0);
  EXPECT_EQ(finger.at(-1.0).z(), 0.5);
  EXPECT_EQ(finger.state.status, 0u);
}

TEST(Limiter, NeverSendsMoreThanTheContactAtTheEndOfARamp) {
  Finger finger;
  finger.settings.start = scene::StartRule::ramp;
  finger.settings.ramp_s = 0.00102;  // a little more than one tick
  for (int i = 0; i < 4; ++i) EXPECT_LE(finger.at(-0.1).z(), 0.05);
  EXPECT_DOUBLE_EQ(finger.state.force.z(), 0.05);
}

/// In contact, and then this tick, the force of which is zero and calls the fault by its name.
template <class Fault>
void expectStop(SafetyBit bit, Fault&& fault) {
  Finger finger;
  finger.at(0.1);
  for (int i = 0; i < 50; ++i) finger.at(-0.1 * i);
  ASSERT_GT(finger.state.force.z(), 2.0);
  EXPECT_TRUE(fault(finger).isZero());
  EXPECT_TRUE(finger.state.status & bit) << finger.state.status;
  EXPECT_TRUE(finger.at(-4.9).isZero()) << "still inside: nothing until it has been outside";
  finger.at(0.1);
  EXPECT_GT(finger.at(-0.1).z(), 0.0) << "and then as ever";
}

TEST(Limiter, SendsNothingInTheTickOfAFault) {
  expectStop(kTipNotFinite, [](Finger& f) { return f.tick({0, kNan, 0}, {0, 0, 2.45}); });
  expectStop(kForceNotFinite, [](Finger& f) { return f.tick({0, 0, -4.9}, {0, kNan, 0}); });
  expectStop(kTipStale, [](Finger& f) { return f.tick({0, 0, -4.9}, {0, 0, 2.45}, 3.0); });
  expectStop(kTipJumped, [](Finger& f) { return f.tick({20, 0, -4.9}, {0, 0, 2.45}); });
  expectStop(kForceJumped, [](Finger& f) {
    f.settings.force_n = 20.0;
    return f.tick({0, 0, -4.9}, {-9, 0, -9});
  });
  const auto reported = [](SafetyBit bit) {
    return [bit](Finger& f) {
      guardTip(f.settings, f.state, {.tip = {0, 0, -4.9}, .tick = f.next++});
      reportFault(f.state, bit);
      return limitForce(f.settings, f.state, makeContact({0, 0, -4.9}, {0, 0, 2.45}), kHooke);
    };
  };
  expectStop(kStalled, reported(kStalled));
  expectStop(kEmergencyStop, reported(kEmergencyStop));
}

/// The status of this tick of a finger that has been in light contact.
template <class Last>
std::uint32_t statusAfterContact(Last&& last) {
  Finger finger;
  finger.at(0.1);
  for (int i = 0; i <= 10; ++i) finger.at(-0.1 * i);
  EXPECT_EQ(finger.state.status, 0u);
  last(finger);
  return finger.state.status;
}

TEST(Limiter, StopsJustOverEachLimitAndNotJustUnderIt) {
  const auto aged = [](double ticks) {
    return statusAfterContact([&](Finger& f) { f.tick({0, 0, -1}, {0, 0, 0.5}, ticks); });
  };
  EXPECT_EQ(aged(2.0), 0u) << "ticks old";
  EXPECT_EQ(aged(2.01), kTipStale);
  const auto moved = [](double mm) { return statusAfterContact([&](Finger& f) { f.tick({mm, 0, -1}, {0, 0, 0.5}); }); };
  EXPECT_EQ(moved(9.99), 0u) << "mm in a tick";
  EXPECT_EQ(moved(10.01), kTipJumped);
  const auto moved_unseen = [](double mm, std::uint64_t missed) {
    return statusAfterContact([&](Finger& f) {
      f.next += missed;
      f.tick({mm, 0, -1}, {0, 0, 0.5});
    });
  };
  EXPECT_EQ(moved_unseen(29.9, 9), 0u) << "3 m/s for ten ticks";
  EXPECT_EQ(moved_unseen(30.1, 9), kTipJumped);
  const auto grown = [](double newtons, std::uint64_t missed) {
    return statusAfterContact([&](Finger& f) {
      f.settings.force_n = 100.0;
      f.next += missed;
      f.tick({0, 0, -1}, {0, 0, 0.5 + newtons});
    });
  };
  EXPECT_EQ(grown(5.99, 0), 0u) << "N in a millisecond";
  EXPECT_EQ(grown(6.01, 0), kForceJumped);
  EXPECT_EQ(grown(11.9, 1), 0u) << "and twice as much in two";
  EXPECT_EQ(grown(12.1, 1), kForceJumped);
  const auto pressed = [](double newtons) {
    return statusAfterContact([&](Finger& f) { f.tick({0, 0, -1}, {0, 0, newtons}); });
  };
  EXPECT_EQ(pressed(3.3), 0u) << "N at most, where no device is known";
  EXPECT_EQ(pressed(3.31), kClamped);
}

TEST(Limiter, ARampTakesHalfASecond) {
  Finger finger;
  finger.settings.start = scene::StartRule::ramp;
  double before = 0.0;
  for (int i = 1; i <= 500; ++i) {
    const double felt = finger.at(-1.0).z();
    EXPECT_GT(felt, before);
    EXPECT_NEAR(felt, 0.5 * i / 500.0, 1e-12);
    before = felt;
  }
  EXPECT_EQ(finger.at(-1.0).z(), 0.5);
  EXPECT_EQ(finger.state.status, 0u);
}

TEST(Limiter, TakesATipThatWasNotSeenForSomeTicksAtItsSpeed) {
  Finger finger;
  finger.at(0.1);
  finger.next += 20;  // ticks that were missed: 40 mm in 21 ms is no jump
  finger.tick({40, 0, 1}, Vec3::Zero());
  EXPECT_FALSE(finger.state.status & kTipJumped);
  finger.tick({80, 0, 1}, Vec3::Zero());
  EXPECT_TRUE(finger.state.status & kTipJumped);
}

TEST(Limiter, LetsAForceEndAtOnce) {
  Finger finger;
  finger.settings.force_n = 100.0;
  finger.at(0.1);
  for (int i = 0; i < 400; ++i) finger.at(-0.1 * i);
  ASSERT_GT(finger.state.force.z(), 19.0);
  finger.tick({0, 0, -39.9}, {0, 0, 0.1});
  EXPECT_EQ(finger.state.status, 0u);
}

TEST(Limiter, UsesTheLastGoodTipWhenTheDeviceGivesNoNumber) {
  const LimiterSettings settings;
  LimiterState state;
  guardTip(settings, state, {.tip = {1, 2, 3}});
  EXPECT_EQ(guardTip(settings, state, {.tip = {kNan, 0, 0}}), Vec3(1, 2, 3));
}

TEST(Limiter, SoftensAllPlacesByOneFactor) {
  for (const double stiffness : {0.5, 2.0}) {
    Finger finger;
    finger.settings.stiffness_factor = 0.25;
    finger.stiffness_n_per_mm = stiffness;
    finger.at(0.1);
    EXPECT_DOUBLE_EQ(finger.at(-0.1).z(), 0.25 * stiffness * 0.1);
  }
}

/// Layered tissue alike everywhere: F = k d^2 / 8.
tissue::ForceLaw squareLaw() {
  tissue::ForceLaw law;
  law.kind = tissue::ForceLaw::Kind::layered;
  law.layers.rows = 1;
  law.layers.thinnest_mm = 10.0;
  for (std::size_t i = 0; i < tissue::LayeredForce::kDepths; ++i) {
    law.layers.factor[tissue::LayeredForce::kFingertip][0][i] = tissue::LayeredForce::kDepthStepMm * i / 8.0;
  }
  return law;
}

TEST(Limiter, HoldsTheSlopeOfASteepPlaceAtTheCapAndLeavesASoftOneAsItIs) {
  const tissue::ForceLaw law = squareLaw();
  LimiterSettings settings;
  settings.stiffness_factor = 0.5;
  settings.cap_n_per_mm = 0.6;
  settings.force_n = 100.0;
  const auto felt = [&](double stiffness, double depth) {
    LimiterState state;
    state.closes_loop = false;
    std::uint64_t tick = 0;
    for (double z = 0.1; z > -depth - 1e-9; z -= 0.1) {
      const double force = z < 0.0 ? tissue::normalForce(law, stiffness, -z) : 0.0;
      guardTip(settings, state, {.tip = {0, 0, z}, .tick = tick++});
      limitForce(settings, state, makeContact({0, 0, z}, {0, 0, force}), law);
    }
    return state.force.z();
  };
  EXPECT_NEAR(felt(0.4, 8.0), 0.5 * 0.4 * 8.0, 1e-9) << "nowhere steeper than 0.4 N/mm";
  // 0.5 x 2 d / 4 reaches 0.6 at 2.4 mm.
  EXPECT_NEAR(felt(2.0, 2.4), 0.5 * 2.0 * 2.4 * 2.4 / 8.0, 1e-9);
  EXPECT_NEAR(felt(2.0, 7.4), 0.72 + 0.6 * 5.0, 1e-9);
}

TEST(Limiter, AToeUnderTheCapIsNoSteeperThanTheCap) {
  const tissue::ForceLaw law = squareLaw();
  LimiterSettings settings;
  settings.cap_n_per_mm = 0.6;
  settings.steepest = 4.0;
  settings.force_n = 100.0;
  LimiterState state;
  state.closes_loop = false;
  double before = 0.0;
  std::uint64_t tick = 0;
  for (double z = 1.9; z > -12.0; z -= 1.0) {
    guardTip(settings, state, {.tip = {0, 0, z}, .tick = tick++});
    const double force = z < 0.0 ? tissue::normalForce(law, 2.0, -z) : 0.0;
    const double felt = limitForce(settings, state, makeContact({0, 0, z}, {0, 0, force}), law).z();
    EXPECT_LE(felt - before, 0.6 + 1e-9) << z;
    EXPECT_GE(felt, before);
    before = felt;
  }
  EXPECT_GT(state.soft.toe_mm, 0.0);
}

TEST(Limiter, GivesAFastFirstTouchAToeAndASlowOneNone) {
  const auto second = [](double step_mm) {
    Finger finger;
    finger.stiffness_n_per_mm = 2.0;
    finger.at(2.1 * step_mm);
    finger.at(1.1 * step_mm);
    finger.at(0.1 * step_mm);
    finger.at(-0.9 * step_mm);
    return finger;
  };
  Finger fast = second(0.5);
  EXPECT_NEAR(fast.state.soft.toe_mm, 2.0 * 0.25 / (2.0 * 0.25), 1e-9);
  EXPECT_LT(fast.state.force.z(), 0.25);
  EXPECT_TRUE(fast.state.status & kSoftened);
  const double toe = fast.state.soft.toe_mm;
  EXPECT_NEAR(fast.at(-1.5).z(), 2.0 * (1.5 - 0.5 * toe), 1e-12);
  EXPECT_EQ(second(0.1).state.soft.toe_mm, 0.0) << "palpation itself is unchanged";
}

TEST(Limiter, TheToeOfABentLawIsThatLawAtALesserDepth) {
  tissue::ForceLaw law;
  law.kind = tissue::ForceLaw::Kind::power;
  law.exponent = 2.0;  // F = k d^2 / 8
  LimiterSettings settings;
  settings.steepest = 4.0;
  LimiterState state;
  state.closes_loop = false;
  std::uint64_t tick = 0;
  for (const double z : {1.6, 1.1, 0.6, 0.1, -0.4, -0.9, -1.4}) {
    guardTip(settings, state, {.tip = {0, 0, z}, .tick = tick++});
    limitForce(settings, state, makeContact({0, 0, z}, {0, 0, z < 0.0 ? 4.0 * z * z / 8.0 : 0.0}), law);
  }
  ASSERT_GT(state.soft.toe_mm, 0.0);
  const double felt_mm = toeDepth(state.soft.toe_mm, 1.4);
  ASSERT_LT(felt_mm, 1.4);
  EXPECT_NEAR(state.force.z(), 4.0 * felt_mm * felt_mm / 8.0, 1e-12);
}

TEST(Limiter, TheToeMakesNoEnergy) {
  // In and out again at other speeds: a function of the depth alone.
  Finger finger;
  finger.stiffness_n_per_mm = 2.0;
  finger.settings.force_n = 100.0;
  for (const double z : {1.0, 0.5, 0.0}) finger.at(z);
  double gained = 0.0;
  double before_z = 0.0;
  double before_f = 0.0;
  const auto go = [&](double z) {
    const double f = finger.at(z).z();
    gained += 0.5 * (f + before_f) * (z - before_z);
    before_z = z;
    before_f = f;
  };
  for (int i = 1; i <= 20; ++i) go(-0.25 * i);
  for (int i = 499; i >= 0; --i) go(-0.01 * i);
  EXPECT_GT(finger.state.counts[10], 400u);
  EXPECT_NEAR(gained, 0.0, 0.05) << "of 25 mJ; the steps are not infinitely small";
}

TEST(Limiter, LeavesWhatPushesNoHandAsItIs) {
  Finger finger;
  finger.settings.limited = false;
  EXPECT_EQ(finger.tick({0, 0, -40}, {0, 0, 80}), Vec3(0, 0, 80));
  EXPECT_EQ(finger.state.status, 0u);
}

TEST(Limiter, AllocatesLocksAndThrowsNothing) {
  Finger finger;
  finger.state.closes_loop = true;
  Random random(5);
  const lab::ThreadCounts before = lab::countsOfThisThread();
  for (int i = 0; i < 100'000; ++i) finger.at(random.uniform(-4.0, 1.0));
  const lab::ThreadCounts counts = lab::countsSince(before);
  if (lab::kCountsCalls) {
    EXPECT_EQ(counts.allocations, 0u);
    EXPECT_EQ(counts.locks, 0u);
  }
}

RC_GTEST_PROP(Limiter, IsAlwaysFiniteAndBounded, (std::uint64_t seed)) {
  Random random(seed);
  Finger finger;
  finger.state.closes_loop = random.below(2) == 0;
  const auto wild = [&]() -> double {
    switch (random.below(12)) {
      case 0:
        return kNan;
      case 1:
        return std::numeric_limits<double>::infinity();
      case 2:
        return 1e308;
      default:
        return random.uniform(-5.0, 5.0);
    }
  };
  for (int i = 0; i < 500; ++i) {
    const Vec3 before = finger.state.force;
    const Vec3 sent = finger.tick({wild(), wild(), wild()}, {wild(), wild(), wild()}, random.uniform(0.0, 2.5));
    RC_ASSERT(sent.allFinite());
    RC_ASSERT(sent.norm() <= 3.3 * (1 + 1e-12));
    RC_ASSERT((sent - before).norm() <= 6.0 || sent.norm() <= before.norm());
    RC_ASSERT((finger.state.status & kFaultBits) == 0u || sent.isZero(0.0));
  }
}

// ---- the scene's own numbers

TEST(DeviceLimits, HoldWhatTheDeviceTakesWhateverTheSceneRequests) {
  scene::SafetySettings safety;
  EXPECT_EQ(device::largestForceN(safety, device::profileOf(safety.device)), 3.3);
  safety.device = scene::DeviceModel::omega_3;
  EXPECT_EQ(device::largestForceN(safety, device::profileOf(safety.device)), 12.0);
  safety.nominal_force_n = 5.0;
  EXPECT_EQ(device::largestForceN(safety, device::profileOf(safety.device)), 5.0);
  safety.nominal_force_n = 50.0;
  EXPECT_EQ(device::largestForceN(safety, device::profileOf(safety.device)), 12.0) << "never silently above it";
  safety.device = scene::DeviceModel::unknown;
  device::Capabilities reported;
  reported.max_force_n = 8.0;
  reported.takes_force = true;
  EXPECT_EQ(device::largestForceN(safety, device::profileOf(safety.device, reported)), 3.3)
      << "a driver's word makes no unknown device stronger than the weakest known one";
  safety.device = scene::DeviceModel::premium_3_0;
  EXPECT_EQ(device::largestForceN(safety, device::profileOf(safety.device, reported)), 3.3) << "nor does a scene's";
  reported.kind = scene::DeviceModel::touch_x;
  EXPECT_EQ(device::largestForceN(safety, device::profileOf(safety.device, reported)), 7.9) << "its own row";
}

TEST(DeviceLimits, NoSceneAsksPastThemAndOnlyTheCommandLineLiftsThem) {
  scene::SafetySettings request;
  request.stiffness_cap_n_per_mm = 5.0;
  request.nominal_force_n = 100.0;
  request.delay_ticks = 3.0;
  const device::DeviceProfile unknown;
  EXPECT_NEAR(stiffnessCap(request, unknown, 0.001), 2.0 / 3.0, 1e-12);
  EXPECT_EQ(device::largestForceN(request, unknown), 3.3);
  const std::vector<std::string> notes = safetyNotes(request, unknown, 0.001);
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_NE(notes[0].find("stiffness_cap_n_per_mm = 5 is more than device, rate and delay"), std::string::npos);
  EXPECT_NE(notes[1].find("nominal_force_n = 100 is more than an unknown device can render; limited to 3.3 N"),
            std::string::npos);
  EXPECT_FALSE(limiterSettings(request, unknown, 0.001).unsafe);

  request.unsafe_stiffness = true;
  EXPECT_EQ(stiffnessCap(request, unknown, 0.001), 5.0);
  EXPECT_EQ(device::largestForceN(request, unknown), 100.0);
  EXPECT_TRUE(limiterSettings(request, unknown, 0.001).unsafe);
  ASSERT_EQ(safetyNotes(request, unknown, 0.001).size(), 1u);
  EXPECT_TRUE(safetyNotes(request, unknown, 0.001)[0].starts_with(kUnsafeMark));

  device::Capabilities driver;
  driver.takes_force = true;
  driver.max_force_n = 8.0;
  EXPECT_EQ(device::largestForceN(request, device::profileOf(request.device, driver)), 8.0)
      << "a driver's word still bounds";
  EXPECT_EQ(device::largestForceN(request, device::profileOf(scene::DeviceModel::omni)), 3.3) << "it can do no more";

  scene::SafetySettings modest;
  modest.unsafe_stiffness = true;
  EXPECT_FALSE(limiterSettings(modest, unknown, 0.001).unsafe) << "consent to what nobody asks for changes nothing";
  EXPECT_TRUE(safetyNotes(modest, unknown, 0.001).empty());
}

TEST(DeviceLimits, GuardsStayTightWhereAHandMayBe) {
  scene::SafetySettings loose;
  loose.passivity = loose.soft_contact = false;
  loose.start = scene::StartRule::ramp;
  loose.ramp_s = 0.0;
  loose.delay_ticks = 0.0;
  loose.max_age_ticks = 1000.0;
  loose.max_jump_mm = loose.max_tip_speed_mm_per_s = loose.max_force_rate_n_per_ms = 1e6;
  const LimiterSettings scripted = limiterSettings(loose, device::DeviceProfile{}, 0.001);
  EXPECT_FALSE(scripted.passivity.on) << "a path that nobody holds is a scene's own affair";
  EXPECT_EQ(scripted.max_jump_mm, 1e6);

  device::Capabilities able;
  able.takes_force = true;
  able.delay_ticks = 1;
  const device::DeviceProfile open = device::profileOf(loose.device, able);
  const LimiterSettings held = limiterSettings(loose, open, 0.001);
  const LimiterSettings usual = limiterSettings(scene::SafetySettings{}, open, 0.001);
  EXPECT_TRUE(held.passivity.on);
  EXPECT_TRUE(held.soft_contact);
  EXPECT_EQ(held.passivity.delay_ticks, usual.passivity.delay_ticks) << "the back end knows of a tick";
  EXPECT_EQ(held.ramp_s, kQuickestRampS);
  EXPECT_EQ(held.max_age_ticks, kLoosestGuard * usual.max_age_ticks);
  EXPECT_EQ(held.max_jump_mm, kLoosestGuard * usual.max_jump_mm);
  EXPECT_EQ(held.max_tip_speed_mm_per_s, kLoosestGuard * usual.max_tip_speed_mm_per_s);
  EXPECT_EQ(held.max_force_rate_n_per_ms, kLoosestGuard * usual.max_force_rate_n_per_ms);
  EXPECT_EQ(safetyNotes(loose, open, 0.001).size(), 8u) << "each is said";
  loose.unsafe_stiffness = true;
  EXPECT_FALSE(limiterSettings(loose, open, 0.001).passivity.on);
  EXPECT_EQ(limiterSettings(loose, open, 0.001).max_jump_mm, held.max_jump_mm) << "no consent loosens a guard";
}

TEST(DeviceLimits, AGuardMayBeFourTimesAsLooseAndARampATenthOfASecond) {
  const device::DeviceProfile open{.open = true};
  const auto held = [&](double scene::SafetySettings::*key, double asked) {
    scene::SafetySettings safety;
    safety.*key = asked;
    return effectiveSafety(safety, open).*key;
  };
  using Safety = scene::SafetySettings;
  EXPECT_EQ(held(&Safety::max_age_ticks, 7.9), 7.9);
  EXPECT_EQ(held(&Safety::max_age_ticks, 8.1), 8.0);
  EXPECT_EQ(held(&Safety::max_jump_mm, 39.9), 39.9);
  EXPECT_EQ(held(&Safety::max_jump_mm, 40.1), 40.0);
  EXPECT_EQ(held(&Safety::max_tip_speed_mm_per_s, 11'999.0), 11'999.0);
  EXPECT_EQ(held(&Safety::max_tip_speed_mm_per_s, 12'001.0), 12'000.0);
  EXPECT_EQ(held(&Safety::max_force_rate_n_per_ms, 23.9), 23.9);
  EXPECT_EQ(held(&Safety::max_force_rate_n_per_ms, 24.1), 24.0);
  EXPECT_EQ(held(&Safety::max_force_rate_n_per_ms, 0.1), 0.1) << "stricter at will";
  EXPECT_EQ(held(&Safety::ramp_s, 0.11), 0.11);
  EXPECT_EQ(held(&Safety::ramp_s, 0.09), 0.1);
  EXPECT_EQ(held(&Safety::ramp_s, 60.0), 60.0);

  device::DeviceProfile scaled = open;
  scaled.motion_scale = 3.0;
  scene::SafetySettings wide;
  wide.max_jump_mm = 119.0;
  EXPECT_EQ(effectiveSafety(wide, scaled).max_jump_mm, 119.0) << "a hand's motion is three times as long in the body";
  wide.max_jump_mm = 121.0;
  EXPECT_EQ(effectiveSafety(wide, scaled).max_jump_mm, 120.0);
  scaled.motion_scale = 0.1;
  EXPECT_EQ(effectiveSafety(wide, scaled).max_jump_mm, 40.0) << "and never held tighter than in the body's own size";
}

TEST(DeviceLimits, APartOfATickOfDelayCountsAsAWholeOne) {
  const device::DeviceProfile omni = device::profileOf(scene::DeviceModel::omni);
  for (const double rate : {250.0, 500.0, 1000.0, 2000.0, 4000.0}) {
    for (double whole = 0.0; whole <= 6.0; ++whole) {
      const double later = stableStiffness(1.0 / rate, whole + 1.0, omni);
      for (const double part : {0.001, 0.5, 0.999}) EXPECT_EQ(stableStiffness(1.0 / rate, whole + part, omni), later);
    }
  }
  EXPECT_EQ(stableStiffness(0.001, 1.0 + 1e-12, omni), 1.1) << "a rounding is none";
  EXPECT_EQ(stableStiffness(0.001, 1.2, omni), 0.5);
  EXPECT_EQ(stableStiffness(0.00101, 0.0, omni), 1.0) << "a slower loop has the row below";
  device::DeviceProfile open = omni;
  open.open = true;
  scene::SafetySettings safety;
  safety.delay_ticks = 2.0;
  EXPECT_NO_THROW(requireStable(open, safety, 0.001));
  safety.delay_ticks = 2.1;
  EXPECT_THROW(requireStable(open, safety, 0.001), Error);
  EXPECT_EQ(limiterSettings(safety, open, 0.001).force_n, 0.0);
  open.delay_ticks = 2.1;
  safety.delay_ticks = 0.0;
  EXPECT_THROW(requireStable(open, safety, 0.001), Error) << "nor less than its back end knows of";
}

TEST(DeviceLimits, CapTheStiffnessByDelayAndRate) {
  const scene::SafetySettings unknown;
  const auto cap = [](scene::SafetySettings safety, double tick_s, double delay) {
    safety.delay_ticks = delay;
    return stiffnessCap(safety, device::profileOf(safety.device), tick_s);
  };
  EXPECT_EQ(cap(unknown, 0.001, 1.0), 2.0);
  EXPECT_EQ(cap(unknown, 0.001, 2.0), 0.8);
  EXPECT_EQ(cap(unknown, 0.002, 1.0), 0.75);
  EXPECT_EQ(cap(unknown, 0.00025, 1.0), 1.8);
  EXPECT_LT(cap(unknown, 0.004, 1.0), 0.35) << "where the nominal device still rests at 250 Hz";
  scene::SafetySettings touch = unknown;
  touch.device = scene::DeviceModel::touch;
  EXPECT_EQ(cap(touch, 0.001, 1.0), 0.4);
  touch.stiffness_cap_n_per_mm = 5.0;
  EXPECT_EQ(cap(touch, 0.001, 1.0), 0.4) << "never above it";
  scene::SafetySettings falcon = unknown;
  falcon.device = scene::DeviceModel::falcon;
  EXPECT_EQ(cap(falcon, 0.001, 1.0), 2.0);
  falcon.device_damping_n_s_per_mm = 1e-3;
  falcon.device_friction_n = 0.4;
  EXPECT_EQ(cap(falcon, 0.001, 1.0), 2.0) << "identified: quieter, not stiffer";
}

TEST(DeviceLimits, ALightOrUnknownDeviceIsHeldSofterThanAHeavyOne) {
  device::DeviceProfile unknown = device::profileOf(scene::DeviceModel::unknown);
  unknown.open = true;
  const device::DeviceProfile omni = device::profileOf(scene::DeviceModel::omni);
  const device::DeviceProfile falcon = device::profileOf(scene::DeviceModel::falcon);
  for (const double rate : {250.0, 500.0, 1000.0, 2000.0, 4000.0}) {
    double before = 100.0;
    for (double delay = 0.0; delay <= 7.0; delay += 0.5) {
      const double light = stableStiffness(1.0 / rate, delay, omni);
      EXPECT_EQ(light, stableStiffness(1.0 / rate, delay, unknown));
      EXPECT_LE(light, stableStiffness(1.0 / rate, delay, falcon));
      EXPECT_LE(light, before) << "more delay is never stiffer";
      before = light;
    }
  }
  EXPECT_EQ(stableStiffness(0.001, 7.0, falcon), 0.0);
  EXPECT_EQ(stableStiffness(0.01, 0.0, falcon), 0.0) << "slower than anything that was measured";
}

TEST(DeviceLimits, RefuseADeviceWhereNoStiffnessIsStable) {
  device::DeviceProfile omni = device::profileOf(scene::DeviceModel::omni);
  EXPECT_TRUE(refusalReason(omni, 0.001, 2.0).empty());
  EXPECT_NE(refusalReason(omni, 0.001, 3.0).find("1000 Hz with 3 ticks"), std::string::npos);
  scene::SafetySettings late;
  late.delay_ticks = 3.0;
  EXPECT_NO_THROW(requireStable(omni, late, 0.001)) << "nobody holds it";
  EXPECT_GT(limiterSettings(late, omni, 0.001).force_n, 0.0);
  EXPECT_FALSE(limiterSettings(late, omni, 0.001).passivity.on) << "from there on the controller itself makes the buzz";
  omni.open = true;
  EXPECT_THROW(requireStable(omni, late, 0.001), Error);
  EXPECT_EQ(limiterSettings(late, omni, 0.001).force_n, 0.0) << "whoever forgets to ask sends nothing";
  late.delay_ticks = 2.0;
  EXPECT_NO_THROW(requireStable(omni, late, 0.001));
  EXPECT_TRUE(limiterSettings(late, omni, 0.001).passivity.on);
}

TEST(DeviceLimits, TrustNothingOfWhatIsOnlyAssumedOfADevice) {
  scene::SafetySettings safety;
  const device::DeviceProfile touch_x = device::profileOf(scene::DeviceModel::touch_x);
  EXPECT_EQ(limiterSettings(safety, touch_x, 0.001).passivity.friction_n, 0.0);
  EXPECT_EQ(limiterSettings(safety, touch_x, 0.001).passivity.damping_n_s_per_mm, 0.0);
  safety.device_damping_n_s_per_mm = 2e-4;
  safety.device_friction_n = 0.06;
  EXPECT_GT(limiterSettings(safety, touch_x, 0.001).passivity.friction_n, 0.0);
}

TEST(DeviceLimits, AllowForTheSteeperForcesOfALargerFinger) {
  const auto steepest = [](double radius_mm) {
    scene::Scene scene;
    scene.body.triangles = 20000;
    scene.fingers.resize(1);
    scene.fingers[0].radius_mm = radius_mm;
    return limiterSettings(*scene::build(scene), device::profileOf(scene::DeviceModel::omega_3)).steepest;
  };
  const double fingertip = steepest(8.0);
  EXPECT_EQ(steepest(0.0), fingertip);
  EXPECT_EQ(steepest(4.0), fingertip) << "settings of a finger may change while it is held";
  EXPECT_GT(steepest(16.0), 1.05 * fingertip);
}

TEST(DeviceLimits, PlacesKeepTheirRatiosUpToTheForceAtWhichPeopleCompare) {
  const auto world = scene::build(scene::Scene{});
  for (const scene::DeviceModel model :
       {scene::DeviceModel::omni, scene::DeviceModel::premium_3_0, scene::DeviceModel::omega_3}) {
    const device::DeviceProfile profile = device::profileOf(model);
    const LimiterSettings settings = limiterSettings(*world, profile);
    const double cap = stiffnessCap(world->scene.safety, profile, settings.tick_s);
    const tissue::ForceLaw& law = world->surface.force_law;
    double first_held_n = 100.0;
    for (std::size_t v = 0; v < world->surface.stiffness_n_per_mm->size(); v += 7) {
      const double stiffness = settings.stiffness_factor * (*world->surface.stiffness_n_per_mm)[v];
      const tissue::PressedPlace place{world->surface.tissue_mm[v], tissue::kFingertipMm};
      const double held = settings.cap_n_per_mm > 0.0 ? settings.cap_n_per_mm : cap;
      double felt = 0.0;
      for (double depth = 0.1; depth < 12.0; depth += 0.1) {
        const double whole = tissue::normalForce(law, stiffness, depth, place);
        const double now = tissue::cappedForce(law.layers, stiffness, depth, place, held);
        ASSERT_LE(now - felt, 0.1 * cap * (1.0 + 1e-9));
        ASSERT_TRUE(whole > settings.compared_n || std::abs(now - whole) <= 1e-6 * whole)
            << place.tissue_mm << " mm, " << depth;
        if (now < whole * (1.0 - 1e-6)) first_held_n = std::min(first_held_n, whole);
        felt = now;
      }
    }
    EXPECT_LE(settings.stiffness_factor * settings.stiffness_n_per_mm, cap * (1.0 + 1e-9));
    EXPECT_GE(settings.compared_n, kComparedForceN * (1.0 - 1e-9));
    if (settings.cap_n_per_mm > 0.0) {
      EXPECT_LT(first_held_n, 1.5 * settings.compared_n) << "and not longer";
    }
  }
}

TEST(DeviceLimits, TheFactorLooksAtTheSteepestPartThatTheForceReaches) {
  tissue::ForceLaw law;
  EXPECT_EQ(stiffnessFactor(law, 1.99, 40.0, 3.3, 2.0), 1.0);
  EXPECT_NEAR(stiffnessFactor(law, 4.0, 40.0, 3.3, 2.0), 0.5, 1e-9);
  law.kind = tissue::ForceLaw::Kind::power;
  law.exponent = 2.0;  // F = k d^2 / 8
  const double factor = stiffnessFactor(law, 4.0, 40.0, 3.3, 1.0);
  const double depth = std::sqrt(8.0 * 3.3 / (factor * 4.0));
  EXPECT_NEAR(factor * 4.0 * depth / 4.0, 1.0, 1e-6) << "the tangent at 3.3 N";
}

}  // namespace
}  // namespace palpate::servo
