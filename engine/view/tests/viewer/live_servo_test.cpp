#include "view/viewer/world/live_servo.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "palpate/base/stopwatch.h"
#include "palpate/scene/scene_file.h"
#include "support/mesh_scene.h"
#include "support/mesh_zoo.h"
#include "support/temporary_folder.h"
#include "support/wait_for.h"

namespace palpate::viewer {
namespace {

std::shared_ptr<const scene::World> sheet(const support::TemporaryFolder& folder, double stiffness) {
  scene::Scene scene = support::meshScene(folder / "sheet.ply", zoo::grid(20, 200.0));
  scene.stiffness.constant_n_per_mm = stiffness;
  return scene::build(scene);
}

device::FingerTarget pressAt(const Vec3& place, double depth_mm) {
  device::FingerTarget target;
  target.present = true;
  target.pressed = true;
  target.place = place;
  target.depth_mm = depth_mm;
  target.radius_mm = 8.0;
  return target;
}

template <class Ready>
bool waitFor(LiveServo& servo, const Ready& ready) {
  return support::waitFor([&] {
    servo.thread().exchange();
    return ready();
  });
}

/// A finger pressed into the middle of the sheet so deep; false if it does not get there.
bool pressed(LiveServo& servo, std::size_t finger, double depth_mm) {
  servo.point(finger, pressAt({100, 100, 0}, depth_mm));
  return waitFor(servo, [&] { return servo.thread().contacts()[finger].contact.depth_mm > depth_mm - 0.1; });
}

TEST(LiveServo, FeelsWhereTheMousePoints) {
  const support::TemporaryFolder folder;
  const auto world = sheet(folder, 0.5);
  LiveServo servo(planFor(world, world->scene, true));
  EXPECT_TRUE(pressed(servo, 1, 4.0));
  EXPECT_NEAR(servo.thread().contacts()[1].device_force.z(), 2.0, 0.1) << "the mouse's force is not limited";
  EXPECT_EQ(servo.thread().contacts()[0].contact.touch, contact::Touch::free) << "the other finger is nowhere";
  const servo::LoopReport report = servo.thread().stop();
  EXPECT_GT(report.ticks, 50u);
}

TEST(LiveServo, ADeviceHoldsTheLeftFingerWithinItsOwnLimitAndTheMouseKeepsTheRight) {
  const support::TemporaryFolder folder;
  const auto world = sheet(folder, 0.5);
  std::vector<Vec3> path;
  // Again and again: a loop that stood still for too long begins with the tip in the skin, and that is free.
  for (int tick = 0; tick < 20'000; ++tick) path.emplace_back(100.0, 100.0, std::max(2.0, 8.0 - 0.02 * (tick % 1000)));
  device::Device held = device::scriptedDevice("held", std::make_shared<const std::vector<Vec3>>(path));
  held.capabilities.max_force_n = 1.5;
  held.capabilities.nominal_stiffness_n_per_mm = 0.4;
  LiveServo servo(planFor(world, world->scene, true, std::span(&held.capabilities, 1)), {{"held", held, {}}});
  ASSERT_EQ(servo.abilities().size(), 1u);
  EXPECT_EQ(servo.abilities()[0].max_force_n, 1.5);
  EXPECT_TRUE(servo.isHeld(0));
  EXPECT_FALSE(servo.isHeld(1));
  EXPECT_TRUE(waitFor(servo, [&] { return servo.thread().contacts()[0].device_force.z() > 1.45; }))
      << "6 mm deep, 3 N if it were the mouse's";
  EXPECT_LE(servo.thread().contacts()[0].device_force.norm(), 1.5 + 1e-9);
  servo.point(1, pressAt({60, 100, 0}, 4.0));
  EXPECT_TRUE(waitFor(servo, [&] { return servo.thread().contacts()[1].contact.depth_mm > 3.5; }));
}

TEST(LiveServo, TheCapIsOfTheRateOfTheLoopNotOfTheSceneThatCame) {
  const support::TemporaryFolder folder;
  const auto world = sheet(folder, 1.5);
  scene::Scene fast = world->scene;
  fast.ticks_per_s = 4000.0;
  const auto felt = scene::rebuilt(*world, fast);
  device::Capabilities able;
  able.takes_force = true;
  EXPECT_EQ(planFor(felt, fast, true, std::span(&able, 1)).limiter.stiffness_factor, 1.0) << "1.5 N/mm at 4 kHz";
  EXPECT_LT(planFor(felt, fast, true, std::span(&able, 1), 0.004).limiter.stiffness_factor, 0.2) << "at 250 Hz";
}

TEST(LiveServo, TakesAnotherWorldBetweenTwoTicksAndGivesTheOldOneBack) {
  const support::TemporaryFolder folder;
  auto soft = sheet(folder, 0.2);
  const auto stiff = sheet(folder, 2.0);
  std::weak_ptr<const scene::World> watched = soft;
  LiveServo servo(planFor(soft, soft->scene, true));
  ASSERT_TRUE(pressed(servo, 0, 3.0));
  servo.thread().change(planFor(stiff, stiff->scene, false));
  soft.reset();
  ASSERT_TRUE(waitFor(servo, [&] { return servo.thread().world() == stiff; }));
  EXPECT_TRUE(watched.expired()) << "freed on this thread, after the exchange";
  EXPECT_TRUE(waitFor(servo, [&] { return servo.thread().contacts()[0].contact.force.z() > 5.0; }));
}

TEST(LiveServo, OfManyChangesTheNewestWins) {
  const support::TemporaryFolder folder;
  const auto world = sheet(folder, 0.5);
  LiveServo servo(planFor(world, world->scene, true));
  ASSERT_TRUE(pressed(servo, 0, 14.0));
  scene::Scene scene = world->scene;
  const double radius_mm = fingerRadius(scene, 0);
  constexpr int kChanges = 50;
  for (int i = 1; i <= kChanges; ++i) {
    scene.contact.finger.max_depth_mm = 8.0 - 0.1 * i;  // with the radius, the deepest that is felt
    servo.thread().change(planFor(world, scene, false));
    if (i % 7 == 0) servo.thread().exchange();
  }
  const auto missing_n = [&] {
    const double felt_mm = scene.contact.finger.max_depth_mm + radius_mm;
    return std::abs(servo.thread().contacts()[0].contact.force.z() - 0.5 * felt_mm);
  };
  EXPECT_TRUE(waitFor(servo, [&] { return missing_n() < 1e-6; })) << missing_n();
  const auto later = Clock::now() + std::chrono::milliseconds(50);
  EXPECT_TRUE(waitFor(servo, [&] { return Clock::now() > later; }));
  EXPECT_LT(missing_n(), 1e-6) << "and it stays";
}

TEST(LiveServo, RefusesSettingsThatMakeNoSense) {
  const support::TemporaryFolder folder;
  const auto world = sheet(folder, 0.5);
  scene::Scene scene = world->scene;
  scene.contact.finger.mu_static = -1.0;
  EXPECT_ANY_THROW(planFor(world, scene, false));
}

}  // namespace
}  // namespace palpate::viewer
