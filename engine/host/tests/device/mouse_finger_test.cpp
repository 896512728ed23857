#include "palpate/device/mouse_finger.h"

#include <gtest/gtest.h>

#include <cmath>

#include "palpate/contact/finger.h"
#include "support/mesh_zoo.h"

namespace palpate::device {
namespace {

constexpr double kRadius = 8.0;

device::FingerTarget over(const Vec3& place) {
  device::FingerTarget target;
  target.present = true;
  target.place = place;
  target.radius_mm = kRadius;
  return target;
}

double depthOf(const Vec3& tip) { return kRadius - tip.z(); }

TEST(MouseFinger, IsNowhereUntilItWasOverTheSkin) {
  device::MouseFinger finger;
  EXPECT_EQ(finger.step({}, Vec3::Zero()).tip, device::kNowhere);
  EXPECT_TRUE(finger.step(over({1, 2, 0}), Vec3::Zero()).jumped);
  EXPECT_FALSE(finger.step(over({1, 2, 0}), Vec3::Zero()).jumped);
  EXPECT_TRUE(finger.step({}, Vec3::Zero()).jumped) << "taken away it must not be dragged through the body";
}

TEST(MouseFinger, HoversOverTheSkinAndGoesDownWithinATenthOfASecondOrSo) {
  device::MouseFinger finger;
  device::FingerTarget target = over(Vec3::Zero());
  EXPECT_NEAR(depthOf(finger.step(target, Vec3::Zero()).tip), -6.0, 1e-9);
  target.pressed = true;
  double deepest = -10.0;
  for (int tick = 0; tick < 120; ++tick) deepest = std::max(deepest, depthOf(finger.step(target, Vec3::Zero()).tip));
  EXPECT_GT(deepest, 5.3);
  for (int tick = 0; tick < 300; ++tick) deepest = std::max(deepest, depthOf(finger.step(target, Vec3::Zero()).tip));
  EXPECT_NEAR(deepest, 6.0, 1e-3) << "and does not overshoot";
}

TEST(MouseFinger, MakesASmoothPathOfSixtyPositionsASecond) {
  device::MouseFinger finger;
  device::FingerTarget target = over(Vec3::Zero());
  target.pressed = true;
  Vec3 last = finger.step(target, Vec3::Zero()).tip;
  for (int tick = 0; tick < 500; ++tick) last = finger.step(target, Vec3::Zero()).tip;
  double longest = 0.0;
  for (int tick = 0; tick < 1000; ++tick) {
    target.place.x() = 3.0 * std::floor(tick / 16.0);  // 3 mm a frame, 190 mm/s
    const Vec3 tip = finger.step(target, Vec3::Zero()).tip;
    longest = std::max(longest, (tip - last).norm());
    last = tip;
  }
  EXPECT_LT(longest, 0.3) << "mm a tick; the mean is 0.19";
}

TEST(MouseFinger, FliesToANearPlaceAndJumpsToAFarOneOnlyInTheAir) {
  device::MouseFinger finger;
  finger.step(over(Vec3::Zero()), Vec3::Zero());
  EXPECT_FALSE(finger.step(over({30, 0, 0}), Vec3::Zero()).jumped);
  EXPECT_TRUE(finger.step(over({300, 0, 0}), Vec3::Zero()).jumped);
  device::FingerTarget pressed = over({300, 0, 0});
  pressed.pressed = true;
  for (int tick = 0; tick < 200; ++tick) finger.step(pressed, Vec3::Zero());
  pressed.place.x() = 0.0;
  EXPECT_FALSE(finger.step(pressed, Vec3::Zero()).jumped) << "a pressed finger drags the skin";
}

TEST(MouseFinger, AppearsBesideTheSkinThatItIsOver) {
  device::MouseFinger finger;
  device::FingerTarget target = over({40, 2, 3});
  target.normal = Vec3::UnitX();
  const Vec3 tip = finger.step(target, Vec3::Zero()).tip;
  EXPECT_GT(tip.x(), 40.0 + kRadius);
  EXPECT_LT((tip.tail<2>() - Vec2(2, 3)).norm(), 0.01);
}

TEST(MouseFinger, TurnsSlowlyWhilePressed) {
  device::MouseFinger finger;
  device::FingerTarget target = over(Vec3::Zero());
  target.pressed = true;
  for (int tick = 0; tick < 300; ++tick) finger.step(target, Vec3::Zero());
  target.normal = Vec3(1, 0, 1).normalized();
  Vec3 tip = Vec3::Zero();
  for (int tick = 0; tick < 150; ++tick) tip = finger.step(target, Vec3::Zero()).tip;
  const double turned = std::atan2(tip.x(), tip.z());
  EXPECT_NEAR(turned, (1.0 - std::exp(-1.0)) * 0.7854, 0.06) << "63 % after one time constant";
}

/// Presses with a force against a law F(depth) and returns the depth it comes to.
template <class Law>
double settledDepth(double force_n, const Law& law) {
  device::MouseFinger finger;
  device::FingerTarget target = over(Vec3::Zero());
  target.pressed = true;
  target.by = device::PressBy::force;
  target.force_n = force_n;
  double depth = 0.0;
  Vec3 felt = Vec3::Zero();
  for (int tick = 0; tick < 1500; ++tick) {
    depth = depthOf(finger.step(target, felt).tip);
    felt = Vec3::UnitZ() * law(std::max(0.0, depth));
  }
  return depth;
}

TEST(MouseFinger, PressedByForceSolvesTheDepth) {
  for (const double stiffness : {0.1, 0.3, 1.2, 3.0}) {
    EXPECT_NEAR(settledDepth(2.0, [&](double d) { return stiffness * d; }), 2.0 / stiffness, 0.02) << stiffness;
  }
  EXPECT_NEAR(settledDepth(2.0, [](double d) { return 0.05 * d * d; }), std::sqrt(40.0), 0.05);
  EXPECT_NEAR(settledDepth(50.0, [](double d) { return 0.1 * d; }), 25.0, 1e-9) << "never deeper than allowed";
}

TEST(MouseFinger, AStiffPlaceShowsAsAShallowerDent) {
  const double soft = settledDepth(3.0, [](double d) { return 0.4 * d; });
  const double stiff = settledDepth(3.0, [](double d) { return 0.8 * d; });
  EXPECT_NEAR(soft / stiff, 2.0, 0.02);
}

TEST(MouseDevice, FeelsTheSkinThroughTheContact) {
  const mesh::TriangleMesh sheet = zoo::grid(20, 200.0);
  const contact::Surface surface = contact::buildSurface(sheet, std::vector<double>(sheet.positions.size(), 0.5));
  device::MouseLink link;
  const device::Device device = device::mouseDevice("mouse", link);
  device::FingerTarget target = over({100, 100, 0});
  target.pressed = true;
  target.depth_mm = 4.0;
  link.target.publish(target);
  contact::FingerSettings settings;
  settings.radius_mm = kRadius;
  contact::FingerState state;
  contact::FingerOutput output{};
  for (std::uint64_t tick = 0; tick < 600; ++tick) {
    device::advance(link);
    output = contact::step(surface, settings, state, device.read_tip(tick));
    device.write_force(output.force);
  }
  EXPECT_NEAR(output.depth_mm, 4.0, 0.05);
  EXPECT_NEAR(output.force.z(), 2.0, 0.05);
}

}  // namespace
}  // namespace palpate::device
