// One suite for every back end: what the servo may rely on, whatever it holds. Hardware is the doubles of its makers'
// libraries, turned by hand, so that "within two ticks" is counted and not waited for.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "host/tests/device/conformance_bench.h"
#include "host/tests/device/remote_client.h"
#include "lab/counters/thread_counts.h"
#include "palpate/base/error.h"
#include "palpate/base/random.h"

namespace palpate::device {
namespace {

const Vec3 kPush(0.25, -0.5, 1.0);

// --- what all of them keep ---

/// A device of each back end that a servo can hold, opened through the table.
struct Held {
  Device device;
  std::function<void()> turn = [] {};
  std::shared_ptr<void> keeps;  ///< what it was opened on
  bool turn_asks_the_system = false;
};

Held heldMouse() {
  auto link = std::make_shared<MouseLink>();
  OpenOptions options;
  options.mouse = link.get();
  return {backEndNamed("mouse").open(options), [link] { advance(*link); }, link};
}

Held heldScript() {
  OpenOptions options;
  options.tips = std::make_shared<const std::vector<Vec3>>(std::vector<Vec3>{{0, 0, 1}, {0, 0, 2}});
  return {backEndNamed("script").open(options), [] {}, nullptr};
}

Held heldPlayback() {
  auto folder = std::make_shared<support::TemporaryFolder>();
  std::ofstream(*folder / "path.csv") << "t_s,x_mm,y_mm,z_mm\n0,0,0,1\n0.5,0,0,2\n";
  OpenOptions options;
  options.which = (*folder / "path.csv").string();
  return {backEndNamed("playback").open(options), [] {}, folder};
}

Held heldHardware(const Hardware& hardware) {
  auto bench = std::make_shared<HardwareBench>(hardware);
  auto device = std::make_shared<Device>(bench->open());
  if (hardware.kind == "haply") {  // a conversation takes its time: one every second tick is young enough
    auto ticks = std::make_shared<std::uint64_t>(0);
    return {*device,
            [bench, device, ticks] {
              if (++*ticks % 2 == 1) device->exchange();
            },
            bench, true};
  }
  return {*device, [bench, device] { bench->turn(*device); }, bench, hardware.asks_the_system};
}

/// With a program at the other end that speaks before every tick.
Held heldRemote() {
  auto client = std::make_shared<RemoteClient>();
  OpenOptions options;
  options.which = std::to_string(RemoteClient::port());
  return {backEndNamed("remote").open(options), [client] { client->send("p 0.5 1 -2"); }, client};
}

/// On a path, so that it moves.
Held heldHand() {
  OpenOptions options;
  options.tips = std::make_shared<const std::vector<Vec3>>(std::vector<Vec3>{{0, 0, 1}, {0, 0, 1.5}, {0, 0, 2}});
  return {backEndNamed("hand").open(options), [] {}, nullptr};
}

Held held(const std::string& back_end) {
  if (back_end == "hand") return heldHand();
  if (back_end == "remote") return heldRemote();
  if (back_end == "mouse") return heldMouse();
  if (back_end == "script") return heldScript();
  if (back_end == "playback") return heldPlayback();
  return heldHardware(hardwareNamed(back_end));
}

class EveryBackEnd : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Named, EveryBackEnd,
                         testing::Values("mouse", "script", "playback", "hand", "openhaptics", "forcedimension",
                                         "haply", "plugin", "remote"),
                         [](const auto& test) { return test.param; });

TEST(BackEnds, AllAreOnTheBench) {
  const std::vector<std::string> on_the_bench = {"mouse",          "script", "playback", "hand",  "openhaptics",
                                                 "forcedimension", "haply",  "plugin",   "remote"};
  EXPECT_EQ(backEndNames(), on_the_bench) << "a new back end joins the conformance suite";
}

TEST_P(EveryBackEnd, GivesFinitePlacesOrNone) {
  Held held = device::held(GetParam());
  for (std::uint64_t tick = 0; tick < 50; ++tick) {
    const Vec3 tip = held.device.read_tip(tick);
    if (!tip.allFinite()) {
      ASSERT_TRUE(held.device.state) << "no place, and nobody to say why";
      EXPECT_NE(held.device.state().faults, 0u);
      EXPECT_LT(tick, 2u) << "hardware that works has a place after a tick";
    }
    if (held.device.write_force) held.device.write_force(kPush);
    held.turn();
  }
}

TEST_P(EveryBackEnd, IsCalledByItsNameAndSaysWhatItIs) {
  Held held = device::held(GetParam());
  EXPECT_TRUE(held.device.name.starts_with(GetParam())) << held.device.name;
  EXPECT_FALSE(backEndNamed(GetParam()).about.empty());
  if (!held.device.capabilities.takes_force || GetParam() == "remote") return;  // a program says nothing of itself
  EXPECT_FALSE(held.device.capabilities.model.empty());
  EXPECT_GT(held.device.capabilities.max_force_n, 0.0);
  EXPECT_GT(held.device.capabilities.rate_hz, 0.0);
  EXPECT_FALSE(held.device.capabilities.workspace_mm.isEmpty());
}

TEST_P(EveryBackEnd, AsksForNothingInAHundredThousandTicks) {
  Held held = device::held(GetParam());
  std::uint64_t tick = 0;
  std::uint64_t allocations = 0;
  std::uint64_t locks = 0;
  const auto count = [&](const lab::ThreadCounts& before) {
    const lab::ThreadCounts asked = lab::countsSince(before);
    allocations += asked.allocations.value_or(0);
    locks += asked.locks.value_or(0);
  };
  const auto ticks = [&](std::uint64_t many) {
    for (const std::uint64_t last = tick + many; tick < last; ++tick) {
      const lab::ThreadCounts before_turn = lab::countsOfThisThread();
      held.turn();
      const lab::ThreadCounts before = held.turn_asks_the_system ? lab::countsOfThisThread() : before_turn;
      const Vec3 tip = held.device.read_tip(tick);
      if (held.device.state) (void)held.device.state();
      if (held.device.write_force) held.device.write_force(1e-3 * tip);
      count(before);
    }
  };
  ASSERT_EQ(lab::countsOfThisThread().allocations.has_value(), lab::kCountsCalls);
  ticks(100);
  allocations = locks = 0;
  ticks(100000);
  EXPECT_EQ(allocations, 0u);
  EXPECT_EQ(locks, 0u);
}

TEST_P(EveryBackEnd, RefusesWithAReasonAndARemedy) {
  OpenOptions options;
  options.which = "/nowhere/no file.csv";
  options.library = "/nowhere/libnone.so";
  options.tips = std::make_shared<const std::vector<Vec3>>();
  const BackEnd& back_end = backEndNamed(GetParam());
  const Probe probe = back_end.probe(options);
  EXPECT_FALSE(probe.available);
  EXPECT_GT(probe.reason.size(), 10u);
  EXPECT_GT(probe.remedy.size(), 5u);
  try {
    back_end.open(options);
    ADD_FAILURE() << "it opened";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(GetParam() == "playback" ? "no file.csv" : GetParam()), std::string::npos)
        << error.what();
  }
}

TEST(BackEnds, AreNamedWithADevice) {
  EXPECT_EQ(deviceNamed("openhaptics").which, "");
  EXPECT_EQ(deviceNamed("openhaptics:Left Device").which, "Left Device");
  EXPECT_EQ(deviceNamed("playback:run/forces.csv:left").which, "run/forces.csv:left");
  EXPECT_THROW(deviceNamed("openhaptic"), Error);
}

TEST(BackEnds, TheMouseGetsItsForce) {
  MouseLink link;
  OpenOptions options;
  options.mouse = &link;
  backEndNamed("mouse").open(options).write_force(kPush);
  EXPECT_EQ(link.felt_force, kPush);
}

TEST(BackEnds, PlaybackGoesToThePlacesOfATrajectoryAtTheServosRate) {
  const Held played = heldPlayback();
  EXPECT_EQ(played.device.read_tip(0), Vec3(0, 0, 1));
  EXPECT_NEAR(played.device.read_tip(250).z(), 1.5, 1e-12);
  EXPECT_EQ(played.device.read_tip(9999), Vec3(0, 0, 2));
}

// --- what hardware keeps ---

class EveryHardware : public testing::TestWithParam<std::string> {
 protected:
  EveryHardware() : hardware(hardwareNamed(GetParam())), bench(hardware) {}
  Hardware hardware;
  HardwareBench bench;

  /// Held at a place, with the force of some ticks on it.
  Device pushed() {
    bench.put({1, 2, 3});
    Device device = bench.open();
    for (int i = 0; i < 10; ++i) bench.tick(device, kPush);
    return device;
  }

  /// Where a device is that has been mended, once it feels again; looked for as reviveDevices does, again and again: on
  /// a busy machine a service may answer too late at first.
  Vec3 backIn(Device& device) {
    Vec3 tip = kNoPlace;
    for (int i = 0; i < 4000 && !(tip.allFinite() && (bench.force() - kPush).norm() < 1e-12); ++i) {
      if (i % 100 == 0 && device.revive) device.revive();
      tip = bench.tick(device, kPush);
    }
    return tip;
  }
};
INSTANTIATE_TEST_SUITE_P(Named, EveryHardware,
                         testing::Values("openhaptics", "forcedimension", "haply", "plugin", "plugin_at_once"),
                         [](const auto& test) { return test.param; });

TEST_P(EveryHardware, GivesMillimetresOfTheBodyFrame) {
  Device device = bench.open();
  bench.put({10, 20, 30});
  bench.tick(device, Vec3::Zero());
  EXPECT_LT((bench.tick(device, Vec3::Zero()) - Vec3(10, 20, 30)).norm(), 1e-9);
}

TEST_P(EveryHardware, TakesNewtonsOfTheBodyFrame) {
  Device device = pushed();
  EXPECT_LT((bench.force() - kPush).norm(), 1e-12);
}

TEST_P(EveryHardware, TurnsScalesAndMovesItsWorkspaceButNotTheSizeOfItsForce) {
  OpenOptions options = bench.options();
  options.axes = hardware.turned_axes;
  options.scale = 2.0;
  options.origin_mm = {100, 0, 50};
  Device device = bench.open(options);
  bench.put({1, 2, 3});
  bench.tick(device, kPush);
  EXPECT_LT((bench.tick(device, kPush) - Vec3(100 + 2 * 3, 2 * 2, 50 - 2 * 1)).norm(), 1e-9);
  EXPECT_LT((bench.force() - Vec3(-kPush.z(), kPush.y(), kPush.x())).norm(), 1e-12);
  EXPECT_LT((device.capabilities.workspace_mm.center() - Vec3(100, 0, 50)).norm(),
            0.7 * device.capabilities.workspace_mm.sizes().norm());
}

TEST_P(EveryHardware, RefusesAMirrorImage) {
  OpenOptions options = bench.options();
  options.axes = "x,y,-z";
  EXPECT_THROW(bench.open(options), Error);
}

TEST_P(EveryHardware, GivesVelocityAndButtons) {
  Device device = bench.open();
  bench.hardware().buttons = 5;
  const Vec3 speed = hardware.axes.transpose() * Vec3(0, 0, -20) / hardware.mm;
  for (std::size_t axis = 0; axis < 3; ++axis) bench.hardware().speed[axis] = speed[static_cast<long>(axis)];
  bench.tick(device, Vec3::Zero());
  bench.tick(device, Vec3::Zero());
  EXPECT_EQ(device.state().buttons, 5u);
  EXPECT_LT((device.state().velocity - Vec3(0, 0, -20)).norm(), 1e-9);
}

TEST_P(EveryHardware, MovesTheMassThatItPushes) {
  Device device = pushed();
  bench.hardware().pinned = false;
  Vec3 tip = Vec3::Zero();
  for (int i = 0; i < 20; ++i) tip = bench.tick(device, {0, 0, 1});
  EXPECT_GT(tip.z(), 4.0) << "1 N on 45 g for 20 ms: 4.4 mm";
  EXPECT_LT(tip.z(), 9.0);
}

TEST_P(EveryHardware, KnowsHowLongAForceTakes) {
  Device device = pushed();
  EXPECT_EQ(device.state().loop_ticks, 1u);
}

TEST_P(EveryHardware, NoForceGoesOverTheDevicesOwnMaximum) {
  Device device = pushed();
  bench.tick(device, {0, 0, 1000});
  EXPECT_NEAR(bench.force().norm(), hardware.most_force_n, 1e-9);
}

TEST_P(EveryHardware, AForceThatIsNoNumberIsNone) {
  Device device = pushed();
  bench.tick(device, {0, NAN, 1});
  EXPECT_EQ(bench.force(), Vec3::Zero());
}

TEST_P(EveryHardware, IsAtRestAfterClose) {
  Device device = pushed();
  device.close();
  EXPECT_EQ(bench.force(), Vec3::Zero());
  EXPECT_FALSE(bench.hardware().open);
  bench.tick(device, kPush);
  EXPECT_EQ(bench.force(), Vec3::Zero()) << "a servo that still runs pushes nobody";
  EXPECT_FALSE(device.read_tip(100).allFinite());
  EXPECT_NE(device.state().faults & kClosed, 0u);
}

TEST_P(EveryHardware, IsAtRestWhenTheLastCopyIsGone) {
  { const Device device = pushed(); }
  EXPECT_EQ(bench.force(), Vec3::Zero());
  EXPECT_FALSE(bench.hardware().open);
}

TEST_P(EveryHardware, OpensAgainAfterClose) {
  pushed().close();
  Device again = pushed();
  EXPECT_LT((bench.force() - kPush).norm(), 1e-12);
  EXPECT_LT((again.read_tip(1000) - Vec3(1, 2, 3)).norm(), 1e-9);
}

/// A fault in mid-contact, and what mends it.
struct Trouble {
  const char* name;
  std::uint32_t bit;
  std::function<void(HardwareBench&, const Hardware&)> make;
  std::function<void(HardwareBench&)> mend;
};
const std::vector<Trouble> kTroubles = {
    {"an error of the driver", kDriverError,
     [](HardwareBench& bench, const Hardware& hardware) { bench.hardware().error = hardware.error; },
     [](HardwareBench& bench) { bench.hardware().error = 0; }},
    {"unplugged", kDriverError, [](HardwareBench& bench, const Hardware&) { bench.hardware().connected = false; },
     [](HardwareBench& bench) { bench.hardware().connected = true; }},
    {"no number", kNoPose, [](HardwareBench& bench, const Hardware&) { bench.hardware().gives_no_number = true; },
     [](HardwareBench& bench) { bench.hardware().gives_no_number = false; }},
    {"old places", kStalePose, [](HardwareBench& bench, const Hardware&) { bench.control().stands = true; },
     [](HardwareBench& bench) { bench.control().stands = false; }},
};

TEST_P(EveryHardware, AFaultLeavesNoPlaceAndZeroForceWithinTwoTicksAndTheDeviceComesBack) {
  for (const Trouble& trouble : kTroubles) {
    Device device = pushed();
    ASSERT_EQ(device.state().faults, 0u) << trouble.name;
    trouble.make(bench, hardware);
    bench.tick(device, kPush);
    bench.tick(device, kPush);
    if (std::string(trouble.name) == "old places") bench.tick(device, kPush);  // two ticks old is young enough
    const Vec3 tip = bench.tick(device, kPush);
    EXPECT_FALSE(tip.allFinite()) << trouble.name;
    EXPECT_NE(device.state().faults & trouble.bit, 0u) << trouble.name;
    const bool library_can_be_told =
        bench.hardware().connected && !bench.control().stands && bench.hardware().error == 0;
    if (library_can_be_told) {
      EXPECT_EQ(bench.force(), Vec3::Zero()) << trouble.name;
    }
    if (trouble.bit != kStalePose) {
      EXPECT_GT(device.explain().size(), 10u) << trouble.name;
    }
    trouble.mend(bench);
    const Vec3 back = backIn(device);
    EXPECT_LT((back - Vec3(1, 2, 3)).norm(), 1e-9) << trouble.name << ": " << device.explain();
    EXPECT_LT((bench.force() - kPush).norm(), 1e-12) << trouble.name;
    EXPECT_EQ(device.explain(), "") << trouble.name;
  }
}

TEST_P(EveryHardware, OfADeviceThatIsLostTheLibraryIsToldNothingMore) {
  Device device = pushed();
  bench.hardware().connected = false;
  for (int i = 0; i < 50; ++i) bench.tick(device, kPush);  // until it is taken for lost
  if (device.revive) device.revive();
  bench.control().stray_calls = 0;
  for (int i = 0; i < 5; ++i) bench.tick(device, kPush);
  device.close();
  EXPECT_EQ(bench.control().stray_calls, 0);
}

TEST_P(EveryHardware, AFaultyDeviceThatStillListensIsToldZeroInTheVeryNextTick) {
  Device device = pushed();
  bench.hardware().gives_no_number = true;
  bench.tick(device, kPush);
  bench.tick(device, kPush);
  EXPECT_EQ(bench.force(), Vec3::Zero());
}

TEST_P(EveryHardware, ASilentServoLeavesZeroForceAfterTwoOfItsTicks) {
  Device device = pushed();
  bench.turn(device);
  EXPECT_LT((bench.force() - kPush).norm(), 1e-12) << "one late tick is forgiven";
  bench.turn(device);
  EXPECT_EQ(bench.force(), Vec3::Zero());
  bench.tick(device, kPush);
  EXPECT_LT((bench.force() - kPush).norm(), 1e-12) << "and it may speak again";
}

TEST_P(EveryHardware, TwoDevicesGetDifferentForcesAndOneStaysWhenTheOtherIsLost) {
  Device one = bench.open();
  Device two = [&] {
    OpenOptions options = bench.options();
    if (GetParam() == "openhaptics") options.which = "Phantom2";
    return bench.open(options);
  }();
  Device* const both[] = {&one, &two};
  bench.put({1, 0, 0}, 0);
  bench.put({0, 0, 7}, 1);
  std::uint64_t ticks = 0;
  Vec3 tips[2];
  const auto tick = [&] {
    tips[0] = one.read_tip(ticks);
    tips[1] = two.read_tip(ticks++);
    one.write_force({1, 0, 0});
    two.write_force({0, -2, 0});
    bench.turn(both);
  };
  for (int i = 0; i < 5; ++i) tick();
  EXPECT_LT((tips[0] - Vec3(1, 0, 0)).norm(), 1e-9);
  EXPECT_LT((tips[1] - Vec3(0, 0, 7)).norm(), 1e-9);
  EXPECT_LT((bench.force(0) - Vec3(1, 0, 0)).norm(), 1e-12);
  EXPECT_LT((bench.force(1) - Vec3(0, -2, 0)).norm(), 1e-12);
  bench.hardware(0).connected = false;
  for (int i = 0; i < 5; ++i) tick();
  EXPECT_FALSE(tips[0].allFinite());
  EXPECT_EQ(two.state().faults, 0u) << "the other finger still feels";
  const long turns = bench.hardware(1).frames;
  if (one.revive) {
    EXPECT_FALSE(one.revive());
  }
  EXPECT_TRUE(bench.hardware(1).open);
  EXPECT_EQ(bench.hardware(1).frames, turns);
  tick();
  EXPECT_EQ(two.state().age_ticks, 0u) << "and was not disturbed by looking for the lost one";
  EXPECT_LT((bench.force(1) - Vec3(0, -2, 0)).norm(), 1e-12);
  one.close();
  for (int i = 0; i < 5; ++i) tick();
  EXPECT_EQ(two.state().faults, 0u);
  EXPECT_LT((bench.force(1) - Vec3(0, -2, 0)).norm(), 1e-12) << "closing one takes nothing from the other";
}

TEST_P(EveryHardware, WithoutANameTwoDevicesAreTheFirstAndTheSecond) {
  Device one = bench.open();
  Device two = bench.open();
  bench.put({4, 0, 0}, 1);
  Device* const both[] = {&one, &two};
  bench.turn(both);
  EXPECT_EQ(two.read_tip(0).x(), 4.0);
  try {
    bench.open();
    ADD_FAILURE() << "a third of two devices";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("use"), std::string::npos) << error.what();
  }
}

TEST_P(EveryHardware, RandomFaultsNeverPushAHandThatHasNoPlace) {
  Device device = pushed();
  Random random(7);
  int without_place = 0;
  for (int tick = 0; tick < hardware.random_ticks; ++tick) {
    if (random.below(40) == 0) bench.hardware().error = random.below(3) == 0 ? hardware.error : 0;
    if (random.below(40) == 0) bench.hardware().gives_no_number = random.below(3) == 0;
    if (random.below(60) == 0) bench.hardware().connected = random.below(4) != 0;
    if (random.below(60) == 0) bench.control().stands = random.below(4) == 0;
    const Vec3 tip = bench.tick(device, Vec3(0, 0, random.below(50)));
    without_place = tip.allFinite() ? 0 : without_place + 1;
    ASSERT_LE(bench.force().norm(), hardware.most_force_n + 1e-9) << "tick " << tick;
    const bool listens = bench.hardware().connected && bench.hardware().error == 0 && !bench.control().stands;
    if (without_place > 2 && listens) {
      ASSERT_EQ(bench.force(), Vec3::Zero()) << "tick " << tick;
    }
  }
  bench.hardware().error = 0;
  bench.hardware().gives_no_number = false;
  bench.hardware().connected = true;
  bench.control().stands = false;
  backIn(device);
  EXPECT_LT((bench.force() - kPush).norm(), 1e-12);
}

}  // namespace
}  // namespace palpate::device
