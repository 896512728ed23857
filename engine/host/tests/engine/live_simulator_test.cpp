#include "palpate/engine/live_simulator.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "host/tests/engine/small_worlds.h"
#include "palpate/base/error.h"
#include "palpate/base/stopwatch.h"
#include "support/wait_for.h"

namespace palpate::engine {
namespace {

const contact::FingerOutput& felt(LiveSimulator& simulator, std::size_t finger = 0) {
  return simulator.felt()[finger].contact;
}

/// From above, so that the skin stops it.
void press(LiveSimulator& simulator, std::size_t finger, double depth_mm) {
  simulator.move(finger, under(-1.0));
  ASSERT_TRUE(support::waitFor([&] { return felt(simulator, finger).tip == under(-1.0); }));
  simulator.move(finger, under(depth_mm));
  ASSERT_TRUE(support::waitFor([&] { return felt(simulator, finger).depth_mm == depth_mm; }));
}

TEST(LiveSimulator, FeelsWhereItsFingersAreMoved) {
  LiveSimulator simulator(sheet(0.5), fingerSettings({}, 2));
  ASSERT_EQ(simulator.fingers(), 2u);
  press(simulator, 1, 3.0);
  EXPECT_NEAR(felt(simulator, 1).force.z(), 1.5, 1e-9);
  EXPECT_EQ(felt(simulator, 0).touch, contact::Touch::free) << "away from the body until it is moved";
  const deform::DeformedSurface& skin = simulator.skin();
  float deepest = 0.0f;
  for (Index v = 0; v < skin.vertices(); ++v) deepest = std::min(deepest, skin.positionAt(v).z());
  EXPECT_LT(deepest, -1.5f);
  EXPECT_GT(simulator.servo().stop().ticks, 1u);
}

TEST(LiveSimulator, ALiftedFingerComesBackFromAnywhereWithoutTouchingTheWay) {
  LiveSimulator simulator(sheet(0.5));
  press(simulator, 0, 3.0);
  simulator.lift(0);
  ASSERT_TRUE(support::waitFor([&] { return felt(simulator).touch == contact::Touch::free; }));
  simulator.move(0, under(5.0));
  ASSERT_TRUE(support::waitFor([&] { return felt(simulator).tip == under(5.0); }));
  EXPECT_EQ(felt(simulator).touch, contact::Touch::free) << "it came from below";
}

TEST(LiveSimulator, GoesOnTouchingAWorldWithTheSameBody) {
  const auto world = sheet(0.5);
  LiveSimulator simulator(world);
  press(simulator, 0, 3.0);
  scene::Scene stiffer = world->scene;
  stiffer.stiffness.constant_n_per_mm = 2.0;
  const auto other = scene::rebuilt(*world, stiffer);
  simulator.change(other);
  EXPECT_TRUE(support::waitFor([&] { return std::abs(felt(simulator).force.z() - 6.0) < 1e-9; }));
  EXPECT_TRUE(support::waitFor([&] { return &simulator.world() == other.get(); }));
}

TEST(LiveSimulator, ForgetsTheTouchOnAnotherBodyAndShowsItsSkin) {
  LiveSimulator simulator(sheet(0.5));
  press(simulator, 0, 3.0);
  EXPECT_EQ(simulator.skin().vertices(), 21u * 21u);
  simulator.change(sheet(0.5, {}, 30));
  EXPECT_TRUE(support::waitFor([&] { return felt(simulator).touch == contact::Touch::free; }));
  EXPECT_TRUE(support::waitFor([&] { return simulator.skin().vertices() == 31u * 31u; }));
}

TEST(LiveSimulator, RefusesAWorldThatDoesNotSuitItsFingers) {
  auto fingers = fingerSettings({}, 1);
  fingers[0].radius_mm = 8.0;
  LiveSimulator simulator(sheet(0.5), fingers);
  scene::Scene scene;
  scene.contact.source = scene::ContactSource::hdb;
  EXPECT_THROW(simulator.change(sheet(0.5, scene)), Error);
}

// Also the test that ThreadSanitizer watches: poses, changes of world and the display's looks, all at once.
TEST(LiveSimulator, PosesArriveWholeWhileWorldsChange) {
  const auto world = sheet(0.5);
  scene::Scene stiffer = world->scene;
  stiffer.stiffness.constant_n_per_mm = 2.0;
  const std::shared_ptr<const scene::World> worlds[] = {world, scene::rebuilt(*world, stiffer)};
  LiveSimulator simulator(world);
  const auto until = Clock::now() + std::chrono::seconds(1);
  std::size_t seen = 0;
  for (int i = 0; Clock::now() < until; ++i) {
    const double at = 60.0 + i % 80;
    simulator.move(0, {at, at, i % 3 == 0 ? 1.0 : -2.0});
    if (i % 50 == 0) simulator.change(worlds[i / 50 % 2]);
    const contact::FingerOutput& newest = felt(simulator);
    if (newest.touch != contact::Touch::free) {
      ASSERT_EQ(newest.tip.x(), newest.tip.y());
      ++seen;
    }
    if (i % 10 == 0) simulator.skin();
  }
  EXPECT_GT(seen, 10u);
}

}  // namespace
}  // namespace palpate::engine
