#include "palpate/device/finger_path.h"

#include <gtest/gtest.h>

#include <cmath>

#include "palpate/base/error.h"
#include "palpate/device/device.h"

namespace palpate::device {
namespace {

scene::Step press(double depth_mm, double seconds) { return {scene::Move::press, seconds, depth_mm}; }
scene::Step lift(double height_mm, double seconds) { return {scene::Move::lift, seconds, 0, height_mm}; }
scene::Step drag(const Vec2& by_mm, double seconds) { return {scene::Move::drag, seconds, 0, 0, by_mm}; }
scene::Step circle(double radius_mm, double turns, double seconds) {
  return {scene::Move::circle, seconds, 0, 0, Vec2::Zero(), radius_mm, turns};
}

scene::Finger fingerThat(std::vector<scene::Step> steps) {
  scene::Finger finger;
  finger.name = "index";
  finger.steps = std::move(steps);
  return finger;
}

std::optional<double> flat(double, double) { return 0.0; }

TEST(FingerScript, PressesDragsAndLiftsOverAFlatPlate) {
  const auto tips = walkScript(fingerThat({press(8, 1), drag({20, -10}, 2), lift(5, 1)}), {}, flat, 0.001);
  ASSERT_EQ(tips.size(), 4001u);
  EXPECT_LT((tips[0] - Vec3(0, 0, 10)).norm(), 1e-12);
  EXPECT_LT((tips[1000] - Vec3(0, 0, -8)).norm(), 1e-12);
  EXPECT_LT((tips[2000] - Vec3(10, -5, -8)).norm(), 1e-9) << "half way after half the time";
  EXPECT_LT((tips[3000] - Vec3(20, -10, -8)).norm(), 1e-12);
  EXPECT_LT((tips[4000] - Vec3(20, -10, 5)).norm(), 1e-12);
}

TEST(FingerScript, CirclesRoundItsPlaceAndComesBack) {
  const auto tips = walkScript(fingerThat({circle(12, 2, 4)}), {}, flat, 0.001);
  EXPECT_LT((tips.back() - tips.front()).norm(), 1e-9);
  double largest = 0.0;
  for (const Vec3& tip : tips) largest = std::max(largest, tip.head<2>().norm());
  EXPECT_NEAR(largest, 12.0, 1e-9);
  EXPECT_LT((tips[2000].head<2>() - Vec2(12, 0)).norm(), 1e-9) << "one turn of two, in the middle of the step";
  const auto many = walkScript(fingerThat({circle(12, 4, 8)}), {}, flat, 0.001);
  EXPECT_LT((many[1000].head<2>() - Vec2(-12, 0)).norm(), 1e-9) << "the spiral lasts half a turn";
}

TEST(FingerScript, MovesWithoutJerks) {
  const auto tips =
      walkScript(fingerThat({press(8, 0.5), circle(15, -1.5, 2), drag({30, 0}, 1), lift(10, 0.5)}), {}, flat, 0.001);
  for (std::size_t i = 2; i < tips.size(); ++i) {
    const double acceleration = (tips[i] - 2.0 * tips[i - 1] + tips[i - 2]).norm() / 1e-6;
    EXPECT_LT(acceleration, 3000.0) << "mm/s^2 at tick " << i;
  }
}

TEST(FingerScript, FollowsTheReliefAtItsDepth) {
  const auto hill = [](double u, double) -> std::optional<double> { return 30.0 * std::cos(u / 40.0); };
  const auto tips = walkScript(fingerThat({press(5, 1), drag({60, 0}, 6)}), {}, hill, 0.001);
  for (std::size_t i = 1100; i < tips.size() - 100; i += 100) {
    EXPECT_NEAR(tips[i].z(), 30.0 * std::cos(tips[i].x() / 40.0) - 5.0, 0.05);
  }
}

TEST(FingerScript, WalksInItsFrame) {
  const ScriptFrame sideways{Vec3(100, 0, 0), Vec3::UnitY(), Vec3::UnitZ(), Vec3::UnitX()};
  const auto tips = walkScript(fingerThat({press(3, 1), drag({7, 9}, 1)}), sideways, flat, 0.001);
  EXPECT_LT((tips.back() - Vec3(97, 7, 9)).norm(), 1e-9);
}

TEST(FingerScript, GoesOnAtTheSameLevelPastTheBorder) {
  const auto plate = [](double u, double) { return u <= 10.0 ? std::optional<double>(4.0) : std::nullopt; };
  const auto tips = walkScript(fingerThat({press(1, 1), drag({50, 0}, 1)}), {}, plate, 0.001);
  EXPECT_NEAR(tips.back().z(), 3.0, 1e-9);
}

TEST(FingerScript, RefusesToStartWhereThereIsNoSkin) {
  const auto nothing = [](double, double) -> std::optional<double> { return std::nullopt; };
  EXPECT_THROW(walkScript(fingerThat({press(1, 1)}), {}, nothing, 0.001), Error);
  EXPECT_THROW(walkScript(fingerThat(std::vector<scene::Step>(4, press(1, 3600))), {}, flat, 0.001), Error);
}

TEST(ScriptedDevice, ReplaysTipsAndRestsAtTheLast) {
  const auto tips = std::make_shared<const std::vector<Vec3>>(std::vector<Vec3>{Vec3(1, 0, 0), Vec3(2, 0, 0)});
  const Device device = scriptedDevice("index", tips);
  EXPECT_EQ(device.read_tip(0), Vec3(1, 0, 0));
  EXPECT_EQ(device.read_tip(1), Vec3(2, 0, 0));
  EXPECT_EQ(device.read_tip(1000), Vec3(2, 0, 0));
  EXPECT_THROW(scriptedDevice("index", std::make_shared<const std::vector<Vec3>>()), Error);
}

}  // namespace
}  // namespace palpate::device
