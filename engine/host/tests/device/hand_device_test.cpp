// A simulated hand opened by name: what its words mean, where it goes, and that it is the same each time.
#include "palpate/device/hand_device.h"

#include <gtest/gtest.h>

#include <cmath>

#include "palpate/base/hash.h"
#include "support/error_message.h"

namespace palpate::device {
namespace {

using scene::DeviceModel;

/// Down by 10 mm in a second, and there.
OpenOptions pressing(const std::string& which = "") {
  std::vector<Vec3> tips;
  for (int tick = 0; tick <= 1000; ++tick) tips.emplace_back(5.0, 0.0, 30.0 - 0.01 * tick);
  OpenOptions options;
  options.which = which;
  options.tips = std::make_shared<const std::vector<Vec3>>(std::move(tips));
  return options;
}

TEST(HandDevice, IsNamedByAHandAndADevice) {
  EXPECT_EQ(handChoice("").device, DeviceModel::touch_x);
  EXPECT_EQ(handChoice("stylus_z,falcon").hand, HandKind::stylus_z);
  EXPECT_EQ(handChoice("stylus_z,falcon").device, DeviceModel::falcon);
  EXPECT_EQ(handChoice("omega_3,arm").hand, HandKind::arm);
  EXPECT_EQ(handChoice("thimble").hand, HandKind::thimble);
  const std::string why = support::thrownMessage([] { handChoice("stylus_q,touch_x"); });
  EXPECT_NE(why.find("did you mean 'stylus_"), std::string::npos) << why;
  EXPECT_THROW(handChoice("unknown"), Error) << "a device of which nothing is known has no mechanics";
}

TEST(HandDevice, ItsLimitsAreThoseOfItsDeviceWhateverTheSceneSays) {
  const Device device = openHand(pressing("omni"));
  const DeviceProfile profile = profileOf(DeviceModel::falcon, device.capabilities);
  EXPECT_EQ(profile.encoder_mm, profileOf(DeviceModel::omni).encoder_mm);
  EXPECT_EQ(profile.force_n, profileOf(DeviceModel::omni).force_n);
}

TEST(HandDevice, ItsWorkspaceLiesAboutTheStartOfItsPath) {
  const Box3 workspace = openHand(pressing()).capabilities.workspace_mm;
  EXPECT_EQ(workspace.center(), Vec3(5.0, 0.0, 30.0));
  EXPECT_GT(workspace.sizes().minCoeff(), 100.0);
}

TEST(HandDevice, ItsTicksAreThoseOfItsLoop) {
  const auto fallen_mm = [](double tick_s) {
    OpenOptions options;
    options.which = "dead_load,omega_3";
    options.tick_s = tick_s;
    const Device device = openHand(options);
    for (std::uint64_t tick = 0; tick < 100; ++tick) {
      (void)device.read_tip(tick);
      device.write_force(Vec3::Zero());
    }
    EXPECT_EQ(device.capabilities.rate_hz, 1.0 / tick_s);
    return -device.read_tip(100).z();
  };
  EXPECT_NEAR(fallen_mm(0.001) / fallen_mm(0.0005), 4.0, 0.6) << "as far as twice the time falls, but for damping";
}

TEST(HandDevice, ItsArmFollowsThePath) {
  const Device device = openHand(pressing());
  EXPECT_NEAR(device.read_tip(0).z(), 30.0, 0.02);
  Vec3 tip = Vec3::Zero();
  for (std::uint64_t tick = 0; tick < 2500; ++tick) {
    tip = device.read_tip(tick);
    device.write_force(Vec3::Zero());
  }
  EXPECT_LT((tip - Vec3(5, 0, 20)).norm(), 1.0) << "but for its device's friction";
}

TEST(HandDevice, GivesWayToAForceAsAHandDoes) {
  for (const HandKind kind :
       {HandKind::stylus_x, HandKind::stylus_y, HandKind::stylus_z, HandKind::thimble, HandKind::arm}) {
    OpenOptions options;
    options.which = wordFor(kind);
    const Device device = openHand(options);
    for (std::uint64_t tick = 0; tick < 2000; ++tick) {
      (void)device.read_tip(tick);
      device.write_force({0, 0, 1.0});
    }
    const HandModel hand = handModel(kind);
    const double grip_mm = hand.grip_n_per_mm > 0.0 ? 1.0 / hand.grip_n_per_mm : 0.0;
    EXPECT_NEAR(device.read_tip(2000).z(), 1.0 / hand.stiffness_n_per_mm + grip_mm, 2.0) << wordFor(kind);
  }
}

TEST(HandDevice, WithoutAPathRestsWhereItWasOpened) {
  OpenOptions options;
  options.origin_mm = {1, 2, 3};
  const Device device = openHand(options);
  for (std::uint64_t tick = 0; tick < 100; ++tick) {
    EXPECT_LT((device.read_tip(tick) - Vec3(1, 2, 3)).norm(), 0.02);
    device.write_force(Vec3::Zero());
  }
}

TEST(HandDevice, ItsTimeBeginsWithTheFirstForce) {
  OpenOptions options;
  options.which = "dead_load,omni";
  const Device device = openHand(options);
  (void)device.read_tip(0);  // whoever opens it looks whether it answers
  EXPECT_EQ(device.read_tip(400).z(), 0.0) << "a window's loop begins much later";
  device.write_force(Vec3::Zero());
  EXPECT_LT(device.read_tip(420).z(), -0.5) << "then the load falls";
}

TEST(HandDevice, TicksThatWereSleptThroughPassWithoutAForceAfterTwo) {
  const auto moved = [](std::uint64_t after) {
    OpenOptions options;
    options.which = "released";
    const Device device = openHand(options);
    (void)device.read_tip(0);
    device.write_force({0, 0, 1.0});
    return device.read_tip(after).z();
  };
  EXPECT_GT(moved(4), moved(2));
  EXPECT_LT(moved(200), 2.0) << "1 N on 45 g for 200 ms would be half a metre";
}

TEST(HandDevice, IsTheSameTwice) {
  const auto run = [] {
    const Device device = openHand(pressing("stylus_z,omni"));
    Hash hash;
    for (std::uint64_t tick = 0; tick < 2000; ++tick) {
      const Vec3 tip = device.read_tip(tick);
      hash.add(tip);
      device.write_force({0, 0, std::max(0.0, 25.0 - tip.z())});
    }
    return hash.value();
  };
  EXPECT_EQ(run(), run());
}

}  // namespace
}  // namespace palpate::device
