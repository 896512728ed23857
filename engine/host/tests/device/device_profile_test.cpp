// What an open device is trusted with: by its type, never by what a driver, a plugin or a scene claims.
#include "palpate/device/device_profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "palpate/device/hardware/forcedimension_driver.h"
#include "palpate/device/hardware/openhaptics_session.h"
#include "palpate/scene/words.h"

namespace palpate::device {
namespace {

using scene::DeviceModel;

Capabilities openDevice(DeviceModel kind, double force_n, double stiffness_n_per_mm = 0.0) {
  Capabilities able;
  able.takes_force = true;
  able.kind = kind;
  able.max_force_n = force_n;
  able.nominal_stiffness_n_per_mm = stiffness_n_per_mm;
  able.delay_ticks = 1;
  return able;
}

TEST(DeviceProfile, TheWeakestKnownForceIsThatOfAnUnknownDevice) {
  double weakest = 1e9;
  for (const auto& model : WordsOf<DeviceModel>::kAll) {
    if (model.value != DeviceModel::unknown) weakest = std::min(weakest, profileOf(model.value).force_n);
  }
  EXPECT_EQ(profileOf(DeviceModel::unknown).force_n, weakest);
  EXPECT_FALSE(profileOf(DeviceModel::unknown).known);
}

TEST(DeviceProfile, ReportsLowerAndNeverRaise) {
  EXPECT_EQ(profileOf(DeviceModel::unknown, openDevice(DeviceModel::unknown, 40.0, 9.0)).force_n, 3.3);
  EXPECT_EQ(profileOf(DeviceModel::unknown, openDevice(DeviceModel::unknown, 1.5)).force_n, 1.5);
  EXPECT_EQ(profileOf(DeviceModel::unknown, openDevice(DeviceModel::omni, 40.0, 9.0)).force_n, 3.3);
  EXPECT_EQ(profileOf(DeviceModel::unknown, openDevice(DeviceModel::omni, 40.0, 9.0)).stiffness_n_per_mm, 0.5);
  EXPECT_EQ(profileOf(DeviceModel::unknown, openDevice(DeviceModel::omni, 3.0, 0.3)).stiffness_n_per_mm, 0.3);
}

TEST(DeviceProfile, ASceneThatNamesAStrongerDeviceGetsTheOneThatOpened) {
  const DeviceProfile omni = profileOf(DeviceModel::premium_3_0, openDevice(DeviceModel::omni, 3.3, 0.5));
  EXPECT_EQ(omni.force_n, 3.3);
  EXPECT_EQ(omni.stiffness_n_per_mm, 0.5);
  EXPECT_EQ(omni.damping_n_s_per_mm, profileOf(DeviceModel::omni).damping_n_s_per_mm);
  const DeviceProfile remote = profileOf(DeviceModel::falcon, openDevice(DeviceModel::unknown, 0.0));
  EXPECT_EQ(remote.force_n, 3.3);
  EXPECT_EQ(remote.damping_n_s_per_mm, 0.0) << "no scene makes an unknown device swallow energy";
  EXPECT_FALSE(remote.known);
  EXPECT_EQ(profileOf(DeviceModel::touch, openDevice(DeviceModel::unknown, 0.0, 2.0)).stiffness_n_per_mm, 0.4)
      << "a scene may lower";
}

TEST(DeviceProfile, WhatTakesNoForceHasTheLimitsOfTheNamedDevice) {
  EXPECT_EQ(profileOf(DeviceModel::premium_3_0, Capabilities{}).force_n, 22.0);
  EXPECT_FALSE(profileOf(DeviceModel::premium_3_0, Capabilities{}).open);
}

TEST(DeviceProfile, ASceneMayLowerTheLargestForceAndRaisesItOnlyWhereItSaysUnsafe) {
  DeviceProfile omni = profileOf(DeviceModel::omni);
  omni.unsafe_force_n = 5.0;
  scene::SafetySettings safety;
  EXPECT_EQ(largestForceN(safety, omni), omni.force_n) << "nothing is asked for";
  safety.nominal_force_n = 0.5;
  EXPECT_EQ(largestForceN(safety, omni), 0.5);
  safety.nominal_force_n = 100.0;
  EXPECT_EQ(largestForceN(safety, omni), omni.force_n);
  safety.unsafe_stiffness = true;
  EXPECT_EQ(largestForceN(safety, omni), 5.0);
}

TEST(DeviceProfile, OfSeveralTheLeastOfEveryLimitHolds) {
  const std::array<Capabilities, 3> devices = {openDevice(DeviceModel::falcon, 8.0, 3.0),
                                               openDevice(DeviceModel::touch_x, 7.9, 1.0), Capabilities{}};
  const DeviceProfile least = profileOf(DeviceModel::unknown, devices);
  EXPECT_TRUE(least.known);
  EXPECT_TRUE(least.open);
  EXPECT_EQ(least.force_n, 7.9);
  EXPECT_EQ(least.stiffness_n_per_mm, 1.0);
  EXPECT_EQ(least.damping_n_s_per_mm, profileOf(DeviceModel::touch_x).damping_n_s_per_mm);
  EXPECT_EQ(least.encoder_mm, 0.064);
  for (const auto limit : {&DeviceProfile::friction_n, &DeviceProfile::mass_kg, &DeviceProfile::damping_n_s_per_mm}) {
    const double of_falcon = profileOf(DeviceModel::falcon).*limit;
    const double of_touch_x = profileOf(DeviceModel::touch_x).*limit;
    ASSERT_NE(of_falcon, of_touch_x);
    EXPECT_EQ(least.*limit, std::min(of_falcon, of_touch_x));
  }
  const std::array<Capabilities, 2> silent = {openDevice(DeviceModel::premium_3_0, 22.0),
                                              openDevice(DeviceModel::unknown, 0.0)};
  EXPECT_EQ(profileOf(DeviceModel::unknown, silent).force_n, 3.3) << "one that says nothing of itself is the weakest";
}

TEST(DeviceProfile, MakersTypesAreRecognisedByTheirNames) {
  EXPECT_EQ(openhaptics::findDeviceModel("PHANTOM Omni"), DeviceModel::omni);
  EXPECT_EQ(openhaptics::findDeviceModel("Touch"), DeviceModel::touch);
  EXPECT_EQ(openhaptics::findDeviceModel("Touch X"), DeviceModel::touch_x);
  EXPECT_EQ(openhaptics::findDeviceModel("PHANTOM Premium 1.5 High Force"), DeviceModel::premium_1_5);
  EXPECT_EQ(openhaptics::findDeviceModel("PHANTOM Premium 3.0"), DeviceModel::premium_3_0);
  EXPECT_EQ(openhaptics::findDeviceModel("PHANTOM Premium 1.0"), DeviceModel::unknown);
  EXPECT_EQ(openhaptics::findDeviceModel("Something Else"), DeviceModel::unknown);
  EXPECT_EQ(forcedimension::profileOf(60)->kind, DeviceModel::falcon);
  EXPECT_EQ(forcedimension::profileOf(33)->kind, DeviceModel::omega_3);
}

TEST(DeviceProfile, AMakersTypeWithoutARowKeepsItsPublishedForceAndSwallowsNothing) {
  Capabilities delta = openDevice(DeviceModel::unknown, 20.0, 5.0);
  delta.documented = true;
  const DeviceProfile profile = profileOf(DeviceModel::unknown, delta);
  EXPECT_TRUE(profile.known);
  EXPECT_EQ(profile.force_n, 20.0);
  EXPECT_EQ(profile.damping_n_s_per_mm, 0.0);
}

}  // namespace
}  // namespace palpate::device
