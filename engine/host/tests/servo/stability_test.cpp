// The loop that a hand would feel: the product's own tick and limiter, closed over simulated devices and hands
// (instruments/study/lab/loops). What is written as a bar here is what docs/explanation/safety.md promises; what a bare
// loop does stands beside it, so that a test that could not fail would be seen. PALPATE_HEAVY=1 runs all 400 random
// systems of a cell.
//
//   T1  growth of an ideal device at b/(T/2 + t_d) +-5 %          AnIdealDeviceFollowsTheory
//   T2  rest after a kick: <= 1 um, within 100 ms                 EveryDeviceComesToRestAfterAKick
//   T3  bare, it swings: > 10, 1, 1 mm                            WithoutTheControllerItOscillates
//   T4  random systems                                            RandomDevicesAndHandsComeToRest
//   T5  first tick of a touch at 0.5 m/s: <= 0.5 N                AFastTouchNeitherKicksNorGainsEnergy
//   T6  any tick: <= 1.3 k v T + 1.0 N                            the same
//   T7  port energy <= 0.01 mJ; at most 3, 5 bounces              the same
//   T8  stiffness within 2 %, 4 % (6 %: the Omni's encoder)       AControlledPressFeelsLikeTheSkin
//   T9  hysteresis -5..5 %, -8..16 % (3 N/mm: above every cap)    the same; AtTheCapsPressAndSlideMeetTheFirstBars
//   T10 noise above 20 Hz: 0.05 N identified, 0.08 not; 0.11 N    the same
//   T11 slide over a map: 0.7 N, 0.09 N of noise, no energy       SlidingOverAMapIsQuiet; AtTheCaps... (0.06 N)
//   T12 ratio of two places within 2 %                            TwoPlacesKeepTheirRatio
//   T13 wrong beliefs                                             StaysAtRestWhenTheDeviceIsNotWhatItIsBelievedToBe
//   T14 amplifier of 0.5 ms at 2.5 N/mm                           HalfAMillisecondOfAmplifierIsWithinTheMargin
//   T15 fault in contact: zero within 2 ticks, <= 0.5 mm          AFaultInContactReachesTheMotorWithinTwoTicks,
//                                                                 AFaultInContactMovesTheHandByLessThanHalfAMillimetre
//   T16 a passive loop is left alone: 0 ticks                     TheControllerLeavesAPassiveLoopAlone
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>

#include "lab/loops/stability_map.h"
#include "lab/workloads/random_lumps.h"
#include "palpate/base/hash.h"
#include "palpate/scene/words.h"

namespace palpate::lab {
namespace {

using device::HandKind;
using device::handModel;
using device::profileOf;
using scene::DeviceModel;

constexpr std::array kHands{HandKind::stylus_x, HandKind::stylus_y, HandKind::stylus_z, HandKind::thimble};

bool heavy() { return std::getenv("PALPATE_HEAVY") != nullptr; }

LoopPlan makeLoopPlan(DeviceModel device, HandKind hand, double stiffness,
                      Protection protection = Protection::assumed) {
  LoopPlan plan;
  plan.device = profileOf(device);
  plan.hand = handModel(hand);
  plan.protection = protection;
  plan.plate.stiffness_n_per_mm = stiffness;
  return plan;
}

std::string called(const LoopPlan& plan, DeviceModel device, HandKind hand) {
  return std::string(wordFor(device)) + " " + std::string(wordFor(hand)) + " " +
         std::to_string(plan.plate.stiffness_n_per_mm) + " N/mm";
}

// T1: the simulation itself. An ideal device crosses from decay to growth where theory says.
TEST(Stability, AnIdealDeviceFollowsTheory) {
  for (const double mass_kg : {0.05, 0.2}) {
    for (const double damping : {0.2e-3, 1.0e-3}) {
      for (const auto& [rate, delay] : {std::pair{500.0, 1.0}, {1000.0, 0.0}, {1000.0, 1.0}, {1000.0, 2.0}}) {
        const LoopPlan plan = idealPlan(mass_kg, damping, rate, delay);
        const double theory = linearLimit(plan);
        EXPECT_NEAR(growthOnset(plan, 0.7 * theory, 1.4 * theory) / theory, 1.0, 0.05)
            << mass_kg << " kg, " << damping << " N s/mm, " << rate << " Hz, " << delay << " ticks";
      }
    }
  }
}

// T2: after a kick the device comes to absolute rest: a limit cycle of one encoder step is felt as buzz.
TEST(Stability, EveryDeviceComesToRestAfterAKick) {
  for (const Protection protection : {Protection::assumed, Protection::identified}) {
    for (const DeviceModel device : nominalDevices()) {
      for (const HandKind hand : kHands) {
        for (const double stiffness : {0.5, 1.0, 2.0, 3.0}) {
          LoopPlan plan = makeLoopPlan(device, hand, stiffness, protection);
          plan.jitter_ticks = 0.15;
          const KickResult result = kick(plan);
          EXPECT_LE(result.peak_to_peak_mm, 0.001) << called(plan, device, hand);
          EXPECT_LE(result.settled_ms, 100.0) << called(plan, device, hand);
        }
      }
    }
  }
}

// T3: and without the controller it does not. These keep the others honest.
TEST(Stability, WithoutTheControllerItOscillates) {
  using enum HandKind;
  const auto swing = [](HandKind hand, double stiffness) {
    return kick(makeLoopPlan(DeviceModel::touch_x, hand, stiffness, Protection::none)).peak_to_peak_mm;
  };
  EXPECT_GT(swing(dead_load, 1.0), 10.0);
  EXPECT_GT(swing(stylus_x, 3.0), 1.0);
  EXPECT_GT(swing(stylus_z, 2.0), 1.0);
}

// T4: devices and hands off their nominal values, of which the loop knows nothing. A suite of its own, so that hunts
// need not run on every change.
TEST(StabilityOfRandomSystems, RandomDevicesAndHandsComeToRest) {
  const std::size_t systems = heavy() ? 400 : 84;
  const auto count = [&](double stiffness, double delay, bool dead_load, Protection protection) {
    return oscillating({stiffness, delay, dead_load, protection}, systems);
  };
  EXPECT_EQ(count(2.0, 1.0, false, Protection::assumed), 0u);
  EXPECT_EQ(count(1.0, 2.0, false, Protection::assumed), 0u);
  EXPECT_EQ(count(1.5, 1.0, true, Protection::assumed), 0u);
  EXPECT_LE(count(3.0, 1.0, false, Protection::assumed), systems / 50) << "2 % at 3 N/mm";
  EXPECT_GT(count(2.0, 1.0, false, Protection::none), systems / 20);
  EXPECT_GT(count(1.5, 1.0, true, Protection::none), systems / 5);
}

// The same over the middle of the stiffest lump that a scene can have, on skin of 0.5 N/mm: 1.9 N/mm together.
TEST(StabilityOfRandomSystems, RandomDevicesAndHandsComeToRestOnTheStiffestLump) {
  const std::size_t systems = heavy() ? 400 : 60;
  RandomCell cell{.stiffness_n_per_mm = 0.5};
  const contact::Lumps lumps{.all = {stiffestLump(Vec3::Zero(), Vec3::UnitZ(), cell.stiffness_n_per_mm)}};
  cell.lumps = std::make_shared<const contact::Lumps>(lumps);
  EXPECT_EQ(oscillating(cell, systems), 0u);
  cell.protection = Protection::none;
  EXPECT_GT(oscillating(cell, systems), 0u);
}

/// The worst of taps with every hand, in 40 phases of the sampling.
TapResult worstTap(DeviceModel device, double stiffness, double speed, Protection protection) {
  TapResult worst;
  const int every = heavy() ? 1 : 4;
  for (const HandKind hand : kHands) {
    for (int phase = 0; phase < 40; phase += every) {
      worst.mergeWorst(tap(makeLoopPlan(device, hand, stiffness, protection), speed, phase / 40.0));
    }
  }
  return worst;
}

// T5, T6, T7: arriving fast.
TEST(Stability, AFastTouchNeitherKicksNorGainsEnergy) {
  for (const DeviceModel device : nominalDevices()) {
    for (const double stiffness : {1.0, 2.0, 3.0}) {
      for (const double speed : {100.0, 300.0, 500.0}) {
        const TapResult worst = worstTap(device, stiffness, speed, Protection::assumed);
        const std::string what = std::string(wordFor(device)) + " " + std::to_string(stiffness) + " N/mm at " +
                                 std::to_string(speed) + " mm/s";
        EXPECT_LE(worst.first_force_n, speed < 500.0 ? 0.55 : 0.5) << what;
        EXPECT_LE(worst.greatest_step_n, 1.3 * stiffness * speed * 0.001 + 1.0) << what;
        EXPECT_LE(worst.port_energy_mj, 0.01) << what;
        EXPECT_LE(worst.bounces, stiffness > 2.0 ? 5 : 3) << what;
      }
    }
  }
  const TapResult bare = worstTap(DeviceModel::touch_x, 3.0, 500.0, Protection::none);
  EXPECT_GT(bare.first_force_n, 1.0);
  EXPECT_GT(bare.port_energy_mj, 10.0);
  EXPECT_GT(bare.bounces, 5);
}

// T8, T9, T10: what is felt is still the skin.
TEST(Stability, AControlledPressFeelsLikeTheSkin) {
  for (const Protection protection : {Protection::assumed, Protection::identified}) {
    for (const DeviceModel device : {DeviceModel::omni, DeviceModel::touch_x, DeviceModel::premium_1_5}) {
      for (const HandKind hand : {HandKind::stylus_x, HandKind::stylus_z, HandKind::thimble}) {
        for (const double stiffness : {0.3, 1.0, 3.0}) {
          const LoopPlan plan = makeLoopPlan(device, hand, stiffness, protection);
          const PressResult result = press(plan);
          const bool soft = stiffness <= 1.0;
          // The Omni's coarse encoder alone makes 5 % at 3 N/mm, with and without the controller.
          const double bias = soft ? 0.02 : device == DeviceModel::omni ? 0.06 : 0.04;
          EXPECT_LE(std::abs(result.stiffness_bias), bias) << called(plan, device, hand);
          EXPECT_GE(result.hysteresis, soft ? -0.05 : -0.08) << called(plan, device, hand);
          EXPECT_LE(result.hysteresis, soft ? 0.05 : 0.16) << called(plan, device, hand);
          const double noise = !soft ? 0.11 : protection == Protection::assumed ? 0.08 : 0.05;
          EXPECT_LE(result.noise_n, noise) << called(plan, device, hand);
        }
      }
    }
  }
}

// T11: over a map from 0.5 to 3 N/mm within 10 mm.
TEST(Stability, SlidingOverAMapIsQuiet) {
  for (const DeviceModel device : {DeviceModel::touch_x, DeviceModel::premium_1_5}) {
    for (const double friction : {0.0, 0.46}) {
      for (const HandKind hand : {HandKind::stylus_x, HandKind::stylus_z}) {
        LoopPlan plan = makeLoopPlan(device, hand, 0.5, Protection::identified);
        plan.plate.other_n_per_mm = 3.0;
        plan.plate.friction = friction;
        const SlideResult result = slide(plan);
        EXPECT_LE(result.greatest_step_n, 0.7) << called(plan, device, hand);
        EXPECT_LE(result.noise_n, 0.09) << called(plan, device, hand);
        EXPECT_LE(result.port_energy_mj, 0.01) << called(plan, device, hand);
      }
    }
  }
  LoopPlan bare = makeLoopPlan(DeviceModel::premium_1_5, HandKind::stylus_z, 0.5, Protection::none);
  bare.plate.other_n_per_mm = 3.0;
  EXPECT_GT(slide(bare).noise_n, 0.17);
  EXPECT_GT(slide(bare).port_energy_mj, 10.0);
}

// T9, T11: above its cap no device is driven; there the first bars hold.
TEST(Stability, AtTheCapsPressAndSlideMeetTheFirstBars) {
  for (const Protection protection : {Protection::assumed, Protection::identified}) {
    for (const DeviceModel device : nominalDevices()) {
      for (const HandKind hand : {HandKind::stylus_x, HandKind::stylus_z}) {
        LoopPlan plan = makeLoopPlan(device, hand, servo::stiffnessCap({}, profileOf(device), 0.001), protection);
        EXPECT_LE(std::abs(press(plan).hysteresis), 0.05) << called(plan, device, hand);
        plan.plate.other_n_per_mm = plan.plate.stiffness_n_per_mm;
        plan.plate.stiffness_n_per_mm /= 6.0;
        EXPECT_LE(slide(plan).noise_n, 0.06) << called(plan, device, hand);
      }
    }
  }
}

// T12: what a palpating finger compares.
TEST(Stability, TwoPlacesKeepTheirRatio) {
  for (const DeviceModel device : {DeviceModel::omni, DeviceModel::touch_x, DeviceModel::premium_1_5}) {
    for (const HandKind hand : {HandKind::stylus_x, HandKind::stylus_z, HandKind::thimble}) {
      for (const double stiffness : {0.5, 1.0}) {
        const double soft = press(makeLoopPlan(device, hand, stiffness)).slope_n_per_mm;
        for (const double ratio : {1.07, 1.14}) {
          const LoopPlan plan = makeLoopPlan(device, hand, ratio * stiffness);
          EXPECT_NEAR(press(plan).slope_n_per_mm / soft / ratio, 1.0, 0.02) << called(plan, device, hand);
        }
      }
    }
  }
}

// T13: what the loop believes may be wrong.
TEST(Stability, StaysAtRestWhenTheDeviceIsNotWhatItIsBelievedToBe) {
  const device::DeviceProfile believed = profileOf(DeviceModel::touch_x);
  for (const double more_delay : {0.0, 1.0}) {
    for (const auto& [mass, damping, friction] : {std::array{0.7, 0.1, 0.3},
                                                  {2.0, 0.1, 0.3},
                                                  {0.7, 3.0, 1.0},
                                                  {2.0, 3.0, 1.0},
                                                  {1.0, 0.1, 1.0},
                                                  {1.0, 1.0, 0.3}}) {
      for (const HandKind hand : kHands) {
        LoopPlan plan = makeLoopPlan(DeviceModel::touch_x, hand, 2.0);
        plan.believed = &believed;
        plan.believed_delay_ticks = plan.delay_ticks + more_delay;
        plan.device.mass_kg *= mass;
        plan.device.damping_n_s_per_mm *= damping;
        plan.device.friction_n *= friction;
        EXPECT_FALSE(kick(plan).oscillates(plan.device.encoder_mm))
            << called(plan, DeviceModel::touch_x, hand) << ", mass x " << mass << ", damping x " << damping
            << ", friction x " << friction << ", delay + " << more_delay;
      }
    }
  }
}

// T14: a slow amplifier counts as delay.
TEST(Stability, HalfAMillisecondOfAmplifierIsWithinTheMargin) {
  for (const DeviceModel device : {DeviceModel::touch_x, DeviceModel::premium_1_5, DeviceModel::omni}) {
    for (const HandKind hand : {HandKind::dead_load, HandKind::stylus_x, HandKind::stylus_z}) {
      LoopPlan plan = makeLoopPlan(device, hand, 2.5);
      plan.amplifier_lag_s = 0.0005;
      EXPECT_FALSE(kick(plan).oscillates(plan.device.encoder_mm)) << called(plan, device, hand);
    }
  }
}

// T15: whatever goes wrong, in whatever hand: no force in that very tick, and at the motor a tick of delay later.
TEST(Stability, AFaultInContactReachesTheMotorWithinTwoTicks) {
  const auto lost = [](LoopPlan plan, const std::function<void(servo::Rig&)>& make_fault) {
    ClosedLoop loop(makeLoopSettings(plan));
    loop.hand().goal.place.z() = -60.0;
    for (int tick = 0; tick < 1000; ++tick) loop.tick();
    EXPECT_GT(loop.hand().motorForce().z(), 1.0) << "it presses";
    make_fault(loop.rig());
    EXPECT_EQ(loop.tick().device_force, Vec3::Zero());
    loop.tick();
    EXPECT_EQ(loop.hand().motorForce(), Vec3::Zero());
    for (int tick = 0; tick < 200; ++tick) EXPECT_EQ(loop.tick().device_force, Vec3::Zero()) << "inside: it stays so";
  };
  servo::EmergencyStop stop;
  stop.press();
  for (const HandKind hand : kHands) {
    const LoopPlan plan = makeLoopPlan(DeviceModel::touch_x, hand, 1.0);
    lost(plan,
         [](servo::Rig& rig) { rig.fingers[0].device.read_tip = [](std::uint64_t) { return device::kNoPlace; }; });
    lost(plan, [&stop](servo::Rig& rig) { rig.emergency_stop = &stop; });
    lost(plan, [](servo::Rig& rig) { rig.fingers[0].device.read_tip = [](std::uint64_t) { return Vec3(40, 0, -9); }; });
  }
}

// T15: a force that is stuck for the two ticks until a fault is answered.
TEST(Stability, AFaultInContactMovesTheHandByLessThanHalfAMillimetre) {
  device::SimulatedHandSettings settings;
  settings.device = profileOf(DeviceModel::touch_x);
  settings.hand = handModel(HandKind::stylus_x);
  settings.delay_ticks = 0.0;
  device::SimulatedHand hand(settings);
  for (int tick = 0; tick < 2; ++tick) hand.writeForce({0, 0, 8.0});
  EXPECT_GT(hand.place().z(), 0.1);
  EXPECT_LE(hand.place().z(), 0.5);
  for (int tick = 2; tick < 10; ++tick) hand.writeForce({0, 0, 8.0});
  EXPECT_GT(hand.place().z(), 5.0) << "what ten ticks would do";
}

// T16: where theory says that the loop is passive by itself, the controller is not heard of.
TEST(Stability, TheControllerLeavesAPassiveLoopAlone) {
  for (const DeviceModel device : nominalDevices()) {
    for (const bool quantised : {true, false}) {
      LoopPlan plan = makeLoopPlan(device, HandKind::stylus_x, 0.0, Protection::identified);
      plan.quantised = quantised;
      plan.plate.stiffness_n_per_mm = 0.5 * linearLimit(plan);
      EXPECT_EQ(kick(plan).damped_share, 0.0) << called(plan, device, HandKind::stylus_x);
      EXPECT_EQ(press(plan).damped_share, 0.0) << called(plan, device, HandKind::stylus_x);
    }
  }
}

// Where a session may start, at the product's own caps: systems off nominal, nearly frictionless ones among them. All
// 60 systems of all cells: `palpate study stability --map`.
TEST(StabilityOfRandomSystems, WhatTheProductAllowsRestsAndGivesNoEnergy) {
  StabilityMapPlan plan = stabilityMapPlan();
  plan.seed = 31;
  plan.systems = heavy() ? 12 : 1;
  plan.threads = 1;
  if (!heavy()) {
    plan.rates = {500.0, 1000.0};
    plan.delays = {0, 1, 2, 3};
  }
  std::size_t bare = 0;
  std::size_t refused = 0;
  double bare_energy = 0.0;
  for (const StabilityCell& cell : measureStabilityMap(plan)) {
    const std::string what = std::to_string(cell.ticks_per_s) + " Hz, " + std::to_string(cell.delay_ticks) +
                             " ticks, " + std::string(wordFor(cell.device)) + ", " + std::string(wordFor(cell.hand)) +
                             ", " + std::to_string(cell.cap_n_per_mm) + " N/mm";
    EXPECT_LE(cell.oscillates_controlled, cell.oscillates_bare) << what;
    refused += cell.refused.empty() ? 0 : 1;
    if (!cell.refused.empty()) continue;
    EXPECT_EQ(cell.oscillates_controlled, 0u) << what;
    EXPECT_LE(cell.port_energy_mj_max, 0.01) << what;
    bare += cell.oscillates_bare;
    bare_energy = std::max(bare_energy, cell.port_energy_bare_mj_max);
  }
  EXPECT_GT(refused, 0u);
  EXPECT_GT(bare, 0u);
  EXPECT_GT(bare_energy, 1.0) << "without the controller it does";
}

// Friction that was assumed and is not there: a limit cycle lived on within a tenth of it.
TEST(StabilityOfRandomSystems, ADeviceWithHardlyAnyFrictionComesToRest) {
  std::size_t oscillate = 0;
  for (std::size_t number = 0; number < 60; ++number) {
    StabilityCell cell;
    cell.device = DeviceModel::premium_3_0;
    cell.hand = HandKind::thimble;
    cell.cap_n_per_mm = 2.0;
    LoopPlan plan = mappedLoop(cell, 5, 3 * number);
    oscillate += kick(plan).oscillates(plan.device.encoder_mm) ? 1 : 0;
  }
  EXPECT_EQ(oscillate, 0u);
}

/// Whether a finger that presses for four seconds is told that the scene is too stiff.
bool warned(DeviceModel device, double stiffness) {
  LoopPlan plan = makeLoopPlan(device, HandKind::stylus_z, stiffness);
  plan.delay_ticks = 2.0;
  ClosedLoop loop(makeLoopSettings(plan));
  std::uint32_t seen = 0;
  for (int tick = 0; tick < 4000; ++tick) {
    loop.hand().goal.place.z() = -8.0 + 3.0 * std::cos(0.006 * tick);
    seen |= loop.tick().safety;
  }
  return (seen & servo::kTooStiff) != 0;
}

TEST(Stability, SaysThatASceneIsTooStiffOnlyWhereItIs) {
  EXPECT_FALSE(warned(DeviceModel::touch_x, 0.5));
  EXPECT_FALSE(warned(DeviceModel::premium_1_5, 1.0));
  EXPECT_TRUE(warned(DeviceModel::touch_x, 6.0));
}

// Two runs of the same hand are the same bits.
TEST(Stability, ASimulatedHandIsDeterministic) {
  const auto run = [] {
    LoopPlan plan = makeLoopPlan(DeviceModel::touch_x, HandKind::stylus_z, 2.0);
    plan.jitter_ticks = 0.2;
    ClosedLoop loop(makeLoopSettings(plan));
    loop.hand().goal.place.z() = -15.0;
    Hash hash;
    for (int tick = 0; tick < 2000; ++tick) {
      loop.tick();
      hash.add(loop.hand().place());
      hash.add(loop.hand().motorForce());
    }
    return hash.value();
  };
  EXPECT_EQ(run(), run());
}

}  // namespace
}  // namespace palpate::lab
