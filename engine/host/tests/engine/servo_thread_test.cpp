#include "palpate/engine/servo_thread.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>

#include "host/tests/engine/small_worlds.h"
#include "lab/counters/thread_counts.h"
#include "palpate/base/error.h"
#include "palpate/base/random.h"
#include "palpate/base/stopwatch.h"
#include "palpate/engine/fingers.h"
#include "palpate/engine/world_builder.h"
#include "support/wait_for.h"

namespace palpate::engine {
namespace {

/// A finger that is where the test puts it. It comes from above, once or in every other tick.
struct Held {
  std::atomic<double> x{103.0};
  std::atomic<double> depth_mm{3.0};
  bool taps = false;
  device::Device device() {
    device::Device device;
    device.name = "held";
    device.read_tip = [this, ticks = 0](std::uint64_t) mutable {
      const bool in_the_air = ++ticks <= 2 || (taps && ticks % 2 == 0);
      return Vec3(x.load(), 101.0, in_the_air ? 1.0 : -depth_mm.load());
    };
    return device;
  }
};

/// One finger without the limits that make forces gradual; a tick of a quarter of a millisecond, so that a test sees
/// many.
ServoPlan makePlan(const std::shared_ptr<const scene::World>& world, double max_depth_mm, bool other_body) {
  auto fingers = fingerSettings(world->scene, 1);
  fingers[0].max_depth_mm = max_depth_mm;
  fingers[0].tick_s = 0.00025;
  ServoPlan plan = servoPlan(world, std::move(fingers));
  plan.other_body = other_body;
  return plan;
}

ServoThread threadWith(ServoPlan plan, Held& held) {
  std::vector<device::Device> devices;
  devices.push_back(held.device());
  return ServoThread(std::move(plan), std::move(devices));
}

template <class Ready>
bool waitFor(ServoThread& servo, const Ready& ready) {
  return support::waitFor([&] {
    servo.exchange();
    return ready();
  });
}

TEST(ServoThread, FeelsWhereTheDeviceIs) {
  Held held;
  auto servo = threadWith(makePlan(sheet(0.5), 40.0, true), held);
  EXPECT_TRUE(waitFor(servo, [&] { return servo.contacts()[0].contact.depth_mm == 3.0; }));
  EXPECT_NEAR(servo.contacts()[0].contact.force.z(), 1.5, 1e-9);
  trace::Sample sample;
  EXPECT_TRUE(servo.pop(sample));
  EXPECT_GT(servo.stop().ticks, 1u);
}

// Else what is so much a second, the catch-up of a finger or the ramp of the limiter, would mean another second.
TEST(ServoThread, GoesOnAtItsOwnRateWhateverTheNextSceneSays) {
  Held held;
  std::atomic<double> tick_s{0.0};
  std::vector<device::Device> devices;
  devices.push_back(held.device());
  ServoThread servo(makePlan(sheet(0.5), 40.0, true), std::move(devices), [&](std::span<servo::FingerChain> fingers) {
    tick_s = fingers[0].contact_settings.tick_s == fingers[0].limiter_settings.tick_s
                 ? fingers[0].limiter_settings.tick_s
                 : std::numeric_limits<double>::quiet_NaN();
  });
  EXPECT_TRUE(waitFor(servo, [&] { return tick_s == 0.00025; })) << "of the finger, not of the scene";
  const auto slower = sheet(2.0);
  servo.change(servoPlan(slower, fingerSettings(slower->scene, 1)));
  ASSERT_TRUE(waitFor(servo, [&] { return servo.world() == slower; }));
  EXPECT_EQ(tick_s, 0.00025);
  EXPECT_EQ(servo.ticksPerS(), 4000.0);
}

TEST(ServoThread, GivesTheOldWorldBackToItsOwner) {
  Held held;
  auto soft = sheet(0.2);
  const auto stiff = sheet(2.0);
  const std::weak_ptr<const scene::World> watched = soft;
  auto servo = threadWith(makePlan(soft, 40.0, true), held);
  EXPECT_FALSE(servo.exchange());
  servo.change(makePlan(stiff, 40.0, false));
  soft.reset();
  ASSERT_TRUE(waitFor(servo, [&] { return servo.world() == stiff; }));
  EXPECT_TRUE(watched.expired()) << "freed on this thread, in the exchange";
  EXPECT_TRUE(waitFor(servo, [&] { return std::abs(servo.contacts()[0].contact.force.z() - 6.0) < 1e-9; }));
  servo.change(makePlan(stiff, 40.0, false));
  EXPECT_TRUE(support::waitFor([&] { return servo.exchange(); }));
  EXPECT_FALSE(servo.exchange()) << "told once";
}

// An older plan is never at work after a newer one, and the newest stays. The plans differ in the deepest depth that is
// felt, and so in the force.
TEST(ServoThread, OfManyChangesTheNewestWins) {
  Held held;
  held.depth_mm = 9.0;
  const auto world = sheet(1.0);
  auto servo = threadWith(makePlan(world, 8.0, true), held);
  const auto felt_n = [&] { return servo.contacts()[0].contact.force.z(); };
  const auto feels = [&](double force_n) {
    return waitFor(servo, [&] { return std::abs(felt_n() - force_n) < 1e-9; });
  };
  ASSERT_TRUE(feels(8.0));
  double least_n = 8.0;
  constexpr int kChanges = 200;
  for (int i = 1; i <= kChanges; ++i) {
    servo.change(makePlan(world, 8.0 - 0.02 * i, false));
    if (i % 7 == 0) servo.exchange();
    if (i % 20 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ASSERT_LE(felt_n(), least_n + 1e-9);
    least_n = felt_n();
  }
  const double newest_n = 8.0 - 0.02 * kChanges;
  EXPECT_TRUE(feels(newest_n)) << felt_n();
  const auto later = Clock::now() + std::chrono::milliseconds(50);
  EXPECT_TRUE(waitFor(servo, [&] { return Clock::now() > later; }));
  EXPECT_NEAR(felt_n(), newest_n, 1e-9);
}

// A finger that forgets what it touched is free until it comes from above again. It must forget for a plan with another
// body, even when a newer plan of the same body came before the servo could adopt that one.
TEST(ServoThread, ForgetsTheTouchWhenOneOfThePlansHadAnotherBody) {
  const auto world = sheet(0.5);
  for (const bool other_body : {false, true}) {
    Held held;
    auto servo = threadWith(makePlan(world, 40.0, true), held);
    ASSERT_TRUE(waitFor(servo, [&] { return servo.contacts()[0].contact.depth_mm == 3.0; }));
    servo.change(makePlan(world, 39.0, false));       // offered at once
    servo.change(makePlan(world, 38.0, other_body));  // waits
    servo.change(makePlan(world, 2.0, false));        // in its place
    const double expected_n = other_body ? 0.0 : 1.0;
    const auto felt_n = [&] { return servo.contacts()[0].contact.force.z(); };
    EXPECT_TRUE(waitFor(servo, [&] { return std::abs(felt_n() - expected_n) < 1e-9; })) << expected_n;
  }
}

TEST(ServoThread, RefusesWhatDoesNotFit) {
  const auto world = sheet(0.5);
  Held held;
  EXPECT_THROW(ServoThread(makePlan(world, 40.0, true), {}), Error);
  auto servo = threadWith(makePlan(world, 40.0, true), held);
  EXPECT_THROW(servo.change(servoPlan(world, fingerSettings(world->scene, 2))), Error);
  auto wrong = fingerSettings(world->scene, 1);
  wrong[0].mu_static = -1.0;
  EXPECT_THROW(servoPlan(world, wrong), Error);
}

TEST(ServoThread, FingersBeyondTheScenesArePointsWithItsFriction) {
  scene::Scene scene;
  scene.contact.finger.mu_static = 0.9;
  scene.fingers.resize(1);
  scene.fingers[0].radius_mm = 7.0;
  const auto fingers = fingerSettings(scene, 3);
  ASSERT_EQ(fingers.size(), 3u);
  EXPECT_EQ(fingers[0].radius_mm, 7.0);
  EXPECT_EQ(fingers[2].radius_mm, 0.0);
  EXPECT_EQ(fingers[2].mu_static, 0.9);
}

// The hammer, also for ThreadSanitizer: two worlds that differ in stiffness and in the deepest depth that is felt are
// exchanged as fast as the servo takes them, under a finger that taps. Every force is one of either plan: nothing is
// felt with the surface of one and the settings of the other.
TEST(ServoThread, NoTickSeesHalfAPlan) {
  Held held;
  held.depth_mm = 5.0;
  held.taps = true;
  const std::shared_ptr<const scene::World> worlds[] = {sheet(0.5), sheet(2.0)};
  const double deepest_mm[] = {1.0, 3.0};
  auto servo = threadWith(makePlan(worlds[0], deepest_mm[0], true), held);
  std::size_t taken = 0;
  std::size_t at_work[2] = {0, 0};
  Random random(7);
  trace::Sample sample;
  const auto until = Clock::now() + std::chrono::seconds(2);
  for (std::size_t i = 1; Clock::now() < until; ++i) {
    servo.change(makePlan(worlds[i % 2], deepest_mm[i % 2], random.below(2) == 0));
    if (random.below(4) != 0) taken += servo.exchange() ? 1 : 0;
    while (servo.pop(sample)) {
      const double force = sample.contact.force.z();
      if (force == 0.0) continue;
      const bool first = std::abs(force - 0.5) < 1e-9;
      const bool second = std::abs(force - 6.0) < 1e-9;
      ASSERT_TRUE(first || second) << force << " N in tick " << sample.tick;
      ++at_work[first ? 0 : 1];
    }
    if (random.below(8) == 0) std::this_thread::sleep_for(std::chrono::microseconds(random.below(800)));
  }
  EXPECT_GT(taken, 100u);
  EXPECT_GT(at_work[0], 100u);
  EXPECT_GT(at_work[1], 100u);
}

TEST(ServoThread, AllocatesAndLocksNothingAlsoWhereWorldsAreExchanged) {
  if (!lab::kCountsCalls) GTEST_SKIP() << "nothing is counted here";
  constexpr std::uint64_t kNotCounted = ~std::uint64_t{0};
  Held held;
  held.taps = true;
  std::atomic<std::uint64_t> allocations{kNotCounted};
  std::atomic<std::uint64_t> locks{kNotCounted};
  std::vector<device::Device> devices;
  devices.push_back(held.device());
  // Counts from the second tick on, on the servo's thread.
  devices[0].write_force = [&, before = lab::ThreadCounts(), ticks = 0](const Vec3&) mutable {
    if (++ticks == 2) before = lab::countsOfThisThread();
    if (ticks <= 2) return;
    const lab::ThreadCounts asked = lab::countsSince(before);
    allocations = asked.allocations.value_or(kNotCounted);
    locks = asked.locks.value_or(kNotCounted);
  };
  const std::shared_ptr<const scene::World> worlds[] = {sheet(0.5), sheet(2.0)};
  ServoThread servo(makePlan(worlds[0], 40.0, true), std::move(devices));
  for (std::size_t taken = 0, i = 1; taken < 50; ++i) {
    servo.change(makePlan(worlds[i % 2], 40.0, true));
    ASSERT_TRUE(waitFor(servo, [&] { return servo.world() == worlds[i % 2]; }));
    ++taken;
  }
  EXPECT_EQ(allocations.load(), 0u);
  EXPECT_EQ(locks.load(), 0u);
}

// Worlds that are felt through the detecting box, with another partition each, built beside and exchanged under a
// finger that presses: the force stays.
TEST(ServoThread, APartitionCanBeReplacedUnderAFinger) {
  Held held;
  scene::Scene scene;
  scene.contact.source = scene::ContactSource::hdb;
  scene.partition.hdb_edge_mm = 60.0;
  scene.partition.build.threshold = 64;
  const auto world = sheet(0.5, scene);
  auto servo = threadWith(makePlan(world, 40.0, true), held);
  ASSERT_TRUE(waitFor(servo, [&] { return servo.contacts()[0].contact.depth_mm > 2.99; }));
  WorldBuilder builder;
  for (const std::size_t threshold : {16, 512, 32}) {
    BuildRequest request{world->scene, world, {}};
    request.scene.partition.build.threshold = threshold;
    request.scene.partition.build.tree = threshold == 512 ? hdb::TreeKind::Bsp : hdb::TreeKind::Octree;
    builder.request(request);
    std::optional<BuildResult> result;
    while (!(result = builder.collectResult())) std::this_thread::yield();
    ASSERT_TRUE(result->world) << result->error;
    servo.change(makePlan(result->world, 40.0, false));
    ASSERT_TRUE(waitFor(servo, [&] { return servo.world() == result->world; }));
    const std::uint64_t tick = servo.contacts()[0].tick;
    ASSERT_TRUE(waitFor(servo, [&] { return servo.contacts()[0].tick > tick + 20; }));
    EXPECT_NEAR(servo.contacts()[0].contact.force.z(), 1.5, 1e-3);
  }
}

}  // namespace
}  // namespace palpate::engine
