// Drivers by the clock: the scheduler of a library, and the thread of a driver that waits, beside a servo that is
// another thread. What is counted elsewhere is waited for here, generously: this is about threads, not about times.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "host/tests/device/conformance_bench.h"
#include "support/wait_for.h"

namespace palpate::device {
namespace {

class InRealTime : public testing::TestWithParam<std::string> {
 protected:
  InRealTime() : bench(hardwareNamed(GetParam())) { bench.control().by_hand = false; }
  ~InRealTime() override { bench.control().by_hand = true; }
  Device open() const {
    OpenOptions options = bench.options();
    options.own_thread = true;
    return bench.open(options);
  }
  HardwareBench bench;
  std::uint64_t ticks = 0;

  /// One tick of a servo that pushes.
  Vec3 push(const Device& device) {
    const Vec3 tip = device.read_tip(ticks++);
    device.write_force({0, 0, 1});
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return tip;
  }
};
INSTANTIATE_TEST_SUITE_P(Named, InRealTime, testing::Values("openhaptics", "forcedimension", "haply", "plugin"),
                         [](const auto& test) { return test.param; });

TEST_P(InRealTime, PlacesAndForcesCross) {
  bench.put({1, 2, 3});
  const Device device = open();
  EXPECT_TRUE(support::waitFor([&] { return (push(device) - Vec3(1, 2, 3)).norm() < 1e-9; }));
  EXPECT_TRUE(support::waitFor([&] {
    push(device);
    return bench.force() == Vec3(0, 0, 1);
  }));
}

TEST_P(InRealTime, AServoThatStopsLeavesNoForce) {
  const Device device = open();
  ASSERT_TRUE(support::waitFor([&] {
    push(device);
    return bench.force() == Vec3(0, 0, 1);
  }));
  EXPECT_TRUE(support::waitFor([&] { return bench.force() == Vec3::Zero(); }));
}

TEST_P(InRealTime, ClosingEndsInZeroForce) {
  const Device device = open();
  ASSERT_TRUE(support::waitFor([&] {
    push(device);
    return bench.force() == Vec3(0, 0, 1);
  }));
  device.close();
  EXPECT_EQ(bench.force(), Vec3::Zero());
  EXPECT_FALSE(bench.hardware().open);
}

TEST_P(InRealTime, ADeviceThatReturnsIsFoundAgain) {
  const Device device = open();
  ASSERT_TRUE(support::waitFor([&] { return push(device).allFinite(); }));
  bench.hardware().connected = false;
  ASSERT_TRUE(support::waitFor([&] { return !push(device).allFinite(); }));
  for (int i = 0; i < 30; ++i) push(device);  // long enough to be taken for lost
  bench.hardware().connected = true;
  EXPECT_TRUE(support::waitFor([&] {
    if (device.revive) device.revive();
    return push(device).allFinite();
  }));
}

}  // namespace
}  // namespace palpate::device
