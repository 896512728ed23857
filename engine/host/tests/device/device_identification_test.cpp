// What a device swallows and how late it is, read from how it swings: against simulated devices whose numbers are
// known, nominal ones and others within wide bounds. The worst of them are in docs/reference/devices.md.
#include "palpate/device/device_identification.h"
#include "palpate/device/device_profile.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "palpate/base/random.h"
#include "palpate/device/simulated_hand.h"
#include "palpate/scene/words.h"
#include "support/counted.h"
#include "support/error_message.h"

namespace palpate::device {
namespace {

using scene::DeviceModel;

constexpr std::array kModels = {DeviceModel::omni,        DeviceModel::touch_x, DeviceModel::premium_1_5,
                                DeviceModel::premium_3_0, DeviceModel::falcon,  DeviceModel::omega_3,
                                DeviceModel::inverse3};

/// Seed 0 is nominal. Others: mass +-30 %, damping 0.3 to 2 times, friction 0.5 to 1.5 times, 0.3 to 3 ticks of delay,
/// an amplifier of up to 0.3 ms, samples up to 0.15 ticks early or late.
SimulatedHandSettings makeDeviceSettings(DeviceModel model, std::uint64_t seed) {
  SimulatedHandSettings settings;
  settings.device = profileOf(model);
  settings.hand = handModel(HandKind::released);
  if (seed == 0) return settings;
  Random random(seed * 7919 + 13);
  settings.device.mass_kg *= random.uniform(0.7, 1.3);
  settings.device.damping_n_s_per_mm *= random.uniform(0.3, 2.0);
  settings.device.friction_n *= random.uniform(0.5, 1.5);
  settings.delay_ticks = random.uniform(0.3, 3.0);
  settings.amplifier_lag_s = random.uniform(0.0, 0.0003);
  settings.jitter_ticks = random.uniform(0.0, 0.15);
  settings.start.x() = random.uniform(-5.0, 5.0);
  settings.seed = seed;
  return settings;
}

SwingPlan planFor(double max_force_n) {
  Capabilities able;
  able.max_force_n = max_force_n;
  return swingPlan(able, 0.001);
}

Swings swung(SimulatedHand& device, double max_force_n) {
  Swings swings(planFor(max_force_n));
  for (std::uint64_t tick = 0; !swings.finished(); ++tick) device.writeForce(swings.tick(tick, device.readTip()));
  return swings;
}

DeviceIdentification identified(const SimulatedHandSettings& settings) {
  SimulatedHand device(settings);
  return identify(swung(device, settings.device.force_n).record());
}

/// The greatest errors: of mass, damping and friction as shares, of the delay in ticks.
struct Errors {
  double mass = 0.0, damping = 0.0, friction = 0.0, delay = 0.0;

  void addErrors(const SimulatedHandSettings& truth, const DeviceIdentification& found) {
    const auto share = [](double is, double should) { return std::abs(is / should - 1.0); };
    mass = std::max(mass, share(found.mass_kg, truth.device.mass_kg));
    damping = std::max(damping, share(found.damping_n_s_per_mm, truth.device.damping_n_s_per_mm));
    friction = std::max(friction, share(found.friction_n, truth.device.friction_n));
    delay = std::max(delay, std::abs(found.delay_ticks - truth.delay_ticks - 1000.0 * truth.amplifier_lag_s));
  }
};

class Identification : public testing::TestWithParam<DeviceModel> {};
INSTANTIATE_TEST_SUITE_P(Devices, Identification, testing::ValuesIn(kModels),
                         [](const auto& test) { return std::string(wordFor(test.param)); });

TEST_P(Identification, FindsWhatTheDeviceIs) {
  const std::uint64_t seeds = std::getenv("PALPATE_HEAVY") != nullptr ? 100 : 6;
  Errors worst;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const SimulatedHandSettings truth = makeDeviceSettings(GetParam(), seed);
    worst.addErrors(truth, identified(truth));
  }
  fmt::print("{:<12} mass {:.1f} %, damping {:.1f} %, friction {:.1f} %, delay {:.2f} ticks, of {} devices\n",
             wordFor(GetParam()), 100.0 * worst.mass, 100.0 * worst.damping, 100.0 * worst.friction, worst.delay,
             seeds);
  EXPECT_LE(worst.mass, 0.01);
  EXPECT_LE(worst.damping, 0.06);
  EXPECT_LE(worst.friction, 0.01);
  EXPECT_LE(worst.delay, 0.3);
}

TEST(Identification, FindsAPushThatIsAlwaysThere) {
  const SimulatedHandSettings settings = makeDeviceSettings(DeviceModel::omni, 0);
  SimulatedHand device(settings);
  device.goal.push.x() = 0.1;  // less than friction: it stays where it is let go
  const DeviceIdentification found = identify(swung(device, settings.device.force_n).record());
  EXPECT_NEAR(found.bias_n, 0.1, 0.01);
  EXPECT_NEAR(found.friction_n, settings.device.friction_n, 0.01);
}

TEST(Identification, IsGentle) {
  for (const DeviceModel model : kModels) {
    const SimulatedHandSettings settings = makeDeviceSettings(model, 0);
    SimulatedHand device(settings);
    const Swings swings = swung(device, settings.device.force_n);
    EXPECT_EQ(swings.trouble(), nullptr);
    double most_n = 0.0;
    double farthest_mm = 0.0;
    for (const double force : swings.record().force_n) most_n = std::max(most_n, std::abs(force));
    for (const double place : swings.record().place_mm) farthest_mm = std::max(farthest_mm, std::abs(place));
    EXPECT_LE(most_n, std::min(2.0, 0.2 * settings.device.force_n) + 1e-12) << wordFor(model);
    EXPECT_LE(farthest_mm, 62.5) << wordFor(model);
    EXPECT_LE(swings.record().place_mm.size(), 20000u) << wordFor(model) << ": it should not last longer than 20 s";
  }
}

TEST(Identification, AHeldDeviceIsRefusedOrLooksLikeOne) {
  SimulatedHandSettings settings = makeDeviceSettings(DeviceModel::touch_x, 0);
  settings.hand = handModel(HandKind::stylus_x);
  SimulatedHand device(settings);
  const Swings swings = swung(device, settings.device.force_n);
  const std::string why = support::thrownMessage([&] {
    const DeviceIdentification found = identify(swings.record());
    if (found.residual_mm > 0.1 || found.mass_kg > 2.0 * settings.device.mass_kg) throw Error("looks held");
  });
  EXPECT_NE(why, "no error");
}

// What should not be ends without force.
TEST(Identification, TroubleIsNoForce) {
  const auto after = [](std::uint64_t tick, const Vec3& tip) {
    Swings swings(planFor(0.0));
    for (std::uint64_t k = 0; k < 120; ++k) (void)swings.tick(k, Vec3::Zero());
    EXPECT_GT(swings.tick(120, Vec3::Zero()).norm(), 0.0) << "it pulls";
    const Vec3 force = swings.tick(tick, tip);
    EXPECT_EQ(force, Vec3::Zero());
    EXPECT_TRUE(swings.finished());
    EXPECT_EQ(swings.tick(tick + 1, Vec3::Zero()), Vec3::Zero());
    return std::string(swings.trouble() == nullptr ? "" : swings.trouble());
  };
  EXPECT_NE(after(121, kNoPlace).find("no position"), std::string::npos);
  EXPECT_NE(after(121, {0, 70, 0}).find("too far"), std::string::npos);
  EXPECT_NE(after(121, {30, 0, 0}).find("too fast"), std::string::npos);
  EXPECT_NE(after(130, {0, 0, 0}).find("away for too long"), std::string::npos);
}

TEST(Identification, ADeviceThatDoesNotMoveIsAnError) {
  Swings swings(planFor(0.0));
  for (std::uint64_t tick = 0; !swings.finished(); ++tick) (void)swings.tick(tick, Vec3::Zero());
  const std::string why = support::thrownMessage([&] { identify(swings.record()); });
  EXPECT_NE(why.find("did not swing"), std::string::npos) << why;
}

TEST(Identification, ATickThatWasMissedDoesLittle) {
  const SimulatedHandSettings truth = makeDeviceSettings(DeviceModel::touch_x, 0);
  SimulatedHand device(truth);
  Swings swings(planFor(truth.device.force_n));
  Vec3 force = Vec3::Zero();
  for (std::uint64_t tick = 0; !swings.finished(); ++tick) {
    if (tick % 50 != 49) force = swings.tick(tick, device.readTip());
    device.writeForce(force);
  }
  Errors errors;
  errors.addErrors(truth, identify(swings.record()));
  EXPECT_LE(errors.mass, 0.02);
  EXPECT_LE(errors.damping, 0.1);
  EXPECT_LE(errors.delay, 0.5);
}

TEST(Identification, ATickAsksForNothing) {
  SimulatedHand device(makeDeviceSettings(DeviceModel::omega_3, 0));
  Swings swings(planFor(12.0));
  support::expectNoAllocation([&] {
    for (std::uint64_t tick = 0; !swings.finished(); ++tick) device.writeForce(swings.tick(tick, device.readTip()));
  });
}

}  // namespace
}  // namespace palpate::device
