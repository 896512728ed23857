// A long time with everything going wrong: two fingers on two makers' drivers (their libraries' doubles), pushed by
// simulated hands through the product's own tick and limiter, while errors, unplugging, lost, old and jumping places,
// stalls and emergency stops come at random. Every tick is judged. A cut of it belongs to the suite; tools/soak runs it
// for as long as one likes (PALPATE_SOAK_S, seconds by the clock).
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <thread>

#include "host/tests/device/conformance_bench.h"
#include "lab/loops/loop_trials.h"
#include "palpate/base/stopwatch.h"
#include "palpate/servo/loop.h"
#include "support/counted.h"

namespace palpate::servo {
namespace {

using device::HardwareBench;
using device::SimulatedHand;

double soakSeconds() {
  const char* text = std::getenv("PALPATE_SOAK_S");
  return text == nullptr ? 0.0 : std::atof(text);
}

/// Of this process, in memory now, MiB.
double residentMb() {
  std::ifstream file("/proc/self/statm");
  double pages = 0.0;
  file >> pages >> pages;
  return pages * static_cast<double>(::sysconf(_SC_PAGESIZE)) / 1048576.0;
}

enum Kind : std::size_t { kError, kUnplugged, kNoNumber, kOldPlaces, kSlow, kJump, kKinds };
constexpr std::array<const char*, kKinds> kKindNames = {"errors",     "unplugged",    "no number",
                                                        "old places", "slow replies", "jumps"};

/// Servo ticks from a fault of the hardware to zero force: the driver's turn sees it, the tick after that knows. A
/// place that is not renewed counts as one for two ticks more.
constexpr std::uint64_t zeroAfter(std::size_t kind) { return kind == kOldPlaces || kind == kSlow ? 4 : 2; }

struct Fault {
  std::size_t kind = kKinds;  ///< none
  std::uint64_t since = 0;
  std::uint64_t until = 0;
};

/// A maker's device with a hand on it.
struct HeldHardware {
  HeldHardware(const device::Hardware& kind, scene::DeviceModel model, device::HandKind hand)
      : hardware(kind), bench(kind), device(bench.open()), mechanics(settingsFor(model, hand)) {}

  static device::SimulatedHandSettings settingsFor(scene::DeviceModel model, device::HandKind hand) {
    device::SimulatedHandSettings settings;
    settings.device = device::profileOf(model);
    settings.hand = device::handModel(hand);
    settings.delay_ticks = 0.0;  // the drivers' own ticks are here
    settings.start.z() = 5.0;
    return settings;
  }

  void start(std::size_t kind, std::uint64_t tick, std::uint64_t ticks) {
    fault = {kind, tick, tick + ticks};
    set(true);
  }
  void mendIfOver(std::uint64_t tick) {
    if (fault.kind == kKinds || tick < fault.until) return;
    set(false);
    fault = {};
  }
  void set(bool on) {
    doubles::DoubleDevice& self = bench.hardware();
    if (fault.kind == kError) self.error = on ? hardware.error : 0;
    if (fault.kind == kUnplugged) self.connected = !on;
    if (fault.kind == kNoNumber) self.gives_no_number = on;
    if (fault.kind == kOldPlaces) bench.control().stands = on;
  }

  /// The driver's turns and the hand's millisecond after a servo tick.
  void pass(std::uint64_t tick) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(tick) / 500.0;
    mechanics.goal.place = Vec3(3.0 * std::sin(0.37 * angle), 0.0, 25.0 * std::sin(angle));
    const bool pushed = bench.hardware().connected && bench.hardware().open;
    mechanics.writeForce(pushed ? bench.force() : Vec3(Vec3::Zero()));
    bench.put(mechanics.readTip() + (fault.kind == kJump ? Vec3(40, 0, 0) : Vec3(0, 0, 0)));
    if (fault.kind != kSlow) bench.turn(device);
  }

  device::Hardware hardware;
  HardwareBench bench;
  device::Device device;
  SimulatedHand mechanics;
  Fault fault;
  std::uint64_t with_force = 0;  ///< ticks since the fault began that had one
};

/// What a soak found.
struct Findings {
  std::uint64_t ticks = 0;
  std::array<std::uint64_t, kKinds> faults{};
  std::uint64_t stalls = 0;
  std::uint64_t stops = 0;
  std::uint64_t ticks_in_contact = 0;
  std::uint64_t longest_told = 0;    ///< ticks with force after a fault that the driver tells of ...
  std::uint64_t longest_silent = 0;  ///< ... and after the last new place, where it only falls silent
  std::uint64_t returns = 0;         ///< calm times in which both fingers felt again
  double largest_share = 0.0;        ///< of a force, of what may be sent
  std::uint64_t allocations = 0;
  std::uint64_t locks = 0;
};

class Soak {
 public:
  explicit Soak(std::uint64_t seed) : random_(seed), surface_(lab::plateSurface(lab::PlateSettings{})) {
    held_.push_back(std::make_unique<HeldHardware>(device::openHapticsHardware(), scene::DeviceModel::omni,
                                                   device::HandKind::stylus_z));
    held_.push_back(std::make_unique<HeldHardware>(device::forceDimensionHardware(), scene::DeviceModel::omega_3,
                                                   device::HandKind::stylus_y));
    RigParts parts;
    parts.solvers = makeSolvers(surface_, nullptr, held_.size());
    parts.fingers.resize(held_.size());
    for (const auto& held : held_) parts.devices.push_back(held->device);
    rig_ = rigOf(std::move(parts));
    rig_.emergency_stop = &stop_;
    for (std::size_t i = 0; i < held_.size(); ++i) {
      const auto profile = device::profileOf(scene::DeviceModel::unknown, held_[i]->device.capabilities);
      rig_.fingers[i].limiter_settings = limiterSettings(scene::SafetySettings{}, profile, rig_.tick_s);
      felt_.push_back(0);
    }
  }

  /// Two seconds of faults, two without, in which every device has to be felt again.
  void episode() {
    for (int i = 0; i < 2000; ++i) tick(true);
    stop_.release();
    for (auto& held : held_) held->fault.until = 0;
    for (int i = 0; i < 1000; ++i) tick(false);  // found again, outside once
    std::ranges::fill(felt_, 0);
    for (int i = 0; i < 1000; ++i) tick(false);
    for (std::size_t i = 0; i < felt_.size(); ++i) EXPECT_GT(felt_[i], 100) << "finger " << i << " did not come back";
    found.returns += std::ranges::all_of(felt_, [](int felt) { return felt > 100; }) ? 1 : 0;
  }

  Findings found;

 private:
  bool chance(std::uint64_t one_in) { return random_.below(one_in) == 0; }

  LoopEvent makeTrouble() {
    for (auto& held : held_) {
      if (held->fault.kind != kKinds || !chance(150)) continue;
      const std::size_t kind = random_.below(kKinds);
      held->start(kind, tick_, 1 + random_.below(chance(4) ? 300 : 12));
      held->with_force = 0;
      ++found.faults[kind];
    }
    if (chance(stop_.pressed() ? 60 : 800)) {
      stop_.pressed() ? stop_.release() : stop_.press();
      found.stops += stop_.pressed() ? 1 : 0;
    }
    if (!chance(500)) return LoopEvent::none;
    ++found.stalls;
    tick_ += 60;
    return LoopEvent::stalled;
  }

  void tick(bool trouble) {
    if (tick_ % 500 == 0) device::reviveDevices(std::vector{held_[0]->device, held_[1]->device});
    for (auto& held : held_) held->mendIfOver(tick_);
    const LoopEvent event = trouble ? makeTrouble() : LoopEvent::none;
    const lab::ThreadCounts before = lab::countsOfThisThread();
    runTick(rig_, tick_, event, samples_);
    const lab::ThreadCounts asked = lab::countsSince(before);
    found.allocations += asked.allocations.value_or(0);
    found.locks += asked.locks.value_or(0);
    for (std::size_t i = 0; i < held_.size(); ++i) judge(i, event);
    for (auto& held : held_) held->pass(tick_);
    for (std::size_t i = 0; i < held_.size(); ++i) judgeMotors(i);
    ++tick_;
    ++found.ticks;
  }

  void judge(std::size_t i, LoopEvent event) {
    const trace::Sample& sample = samples_[i];
    const Fault& fault = held_[i]->fault;
    const double most_n = rig_.fingers[i].limiter_settings.force_n;
    const double force = sample.device_force.norm();
    const bool zero = sample.device_force == Vec3::Zero();
    found.largest_share = std::max(found.largest_share, force / most_n);
    found.ticks_in_contact += zero ? 0 : 1;
    felt_[i] += zero ? 0 : 1;
    ASSERT_TRUE(sample.device_force.allFinite()) << "tick " << tick_;
    ASSERT_LE(force, most_n * (1.0 + 1e-12)) << "tick " << tick_;
    const bool must_be_zero = (sample.safety & kFaultBits) != 0 || stop_.pressed() || event == LoopEvent::stalled;
    ASSERT_TRUE(zero || !must_be_zero) << "tick " << tick_ << ", finger " << i << ", safety " << sample.safety;
    if (fault.kind >= kJump) return;  // a jump shows in its status, and is a place like any other afterwards
    if (zero) return;
    ASSERT_LT(tick_, fault.since + zeroAfter(fault.kind)) << "finger " << i << ", " << kKindNames[fault.kind];
    std::uint64_t& longest = fault.kind < kOldPlaces ? found.longest_told : found.longest_silent;
    longest = std::max(longest, ++held_[i]->with_force);
  }

  /// What the motors have: never more than the device takes, and nothing where a device that listens has no place.
  void judgeMotors(std::size_t i) {
    const HeldHardware& held = *held_[i];
    ASSERT_LE(held.bench.force().norm(), held.hardware.most_force_n * (1.0 + 1e-9)) << "tick " << tick_;
    if (held.fault.kind == kNoNumber && tick_ >= held.fault.since + 2) {
      ASSERT_EQ(held.bench.force(), Vec3::Zero()) << "tick " << tick_ << ", finger " << i;
    }
  }

  Random random_;
  contact::Surface surface_;
  std::vector<std::unique_ptr<HeldHardware>> held_;
  Rig rig_;
  EmergencyStop stop_;
  std::array<trace::Sample, 2> samples_;
  std::uint64_t tick_ = 0;
  std::vector<int> felt_;
};

void say(const Findings& found, double wall_s, double grown_mb) {
  std::string faults;
  for (std::size_t kind = 0; kind < kKinds; ++kind)
    faults += fmt::format(", {} {}", found.faults[kind], kKindNames[kind]);
  fmt::print("soak: {:.0f} s of ticks in {:.0f} s, two fingers, {} with force; {} stalls, {} emergency stops{}\n",
             static_cast<double>(found.ticks) * 1e-3, wall_s, found.ticks_in_contact, found.stalls, found.stops,
             faults);
  fmt::print(
      "      largest force {:.3f} of the clamp; ticks with force after a fault: {} at most, {} where the driver says "
      "nothing\n",
      found.largest_share, found.longest_told, found.longest_silent);
  fmt::print("      {} times both came back; {} allocations and {} locks in ticks, memory grew by {:.2f} MiB\n",
             found.returns, found.allocations, found.locks, grown_mb);
}

TEST(Soak, RandomFaultsLeaveNoForceThatShouldNotBe) {
  Soak soak(2026);
  const auto started = Clock::now();
  constexpr int kWarmEpisodes = 4;
  constexpr int kEpisodes = 20;  // 80 s of ticks
  double warm_mb = 0.0;
  for (int i = 0; i < kEpisodes || secondsSince(started) < soakSeconds(); ++i) {
    if (i == kWarmEpisodes) warm_mb = residentMb();
    soak.episode();
    ASSERT_FALSE(testing::Test::HasFailure()) << "episode " << i;
  }
  const double grown_mb = residentMb() - warm_mb;
  say(soak.found, secondsSince(started), grown_mb);
  EXPECT_GE(soak.found.ticks, 60000u);
  EXPECT_GT(soak.found.largest_share, 0.99) << "the clamp was at work";
  EXPECT_GT(soak.found.ticks_in_contact, soak.found.ticks / 10) << "else nothing was at stake";
  for (std::size_t kind = 0; kind < kKinds; ++kind) EXPECT_GT(soak.found.faults[kind], 5u) << kKindNames[kind];
  EXPECT_GT(soak.found.stalls + soak.found.stops, 10u);
  EXPECT_EQ(soak.found.allocations, 0u);
  EXPECT_EQ(soak.found.locks, 0u);
  if (lab::kCountsCalls) {
    EXPECT_LE(grown_mb, 1.0);
  }
}

/// With a driver whose loop is its own.
device::Device openOnItsOwnThread(const HardwareBench& bench) {
  device::OpenOptions options = bench.options();
  options.own_thread = true;
  return bench.open(options);
}

Rig rigByTheClock(const contact::Surface& surface, const std::vector<device::Device>& devices) {
  RigParts parts;
  parts.solvers = makeSolvers(surface, nullptr, 2);
  parts.fingers.resize(2);
  parts.devices = devices;
  parts.limiter = limiterSettings(scene::SafetySettings{}, device::profileOf(scene::DeviceModel::omni), 0.001);
  return rigOf(std::move(parts));
}

/// The hand goes up and down; the cable is out now and then, and the driver slow.
void disturb(HardwareBench& bench, double now_s, Random& random) {
  bench.put({0, 0, 2.5 * std::cos(2.0 * std::numbers::pi * now_s / 0.5)});
  bench.hardware().connected = std::fmod(now_s, 0.7) < 0.5 || random.below(8) != 0;
  bench.control().slow_us = std::fmod(now_s, 0.3) < 0.02 ? 3000 : 0;
}

struct FeltByTheClock {
  std::uint64_t with_force = 0;  ///< ticks
  double largest_n = 0.0;

  void drain(LoopLinks& links) {
    trace::Sample sample;
    while (links.samples.pop(sample)) {
      const double force = sample.device_force.norm();
      with_force += force > 0.0 ? 1 : 0;
      largest_n = std::max(largest_n, force);
      if ((sample.safety & kFaultBits) != 0) {
        EXPECT_EQ(force, 0.0) << "tick " << sample.tick;
      }
    }
  }
};

/// Disturbs both benches until the loop is over, which it ends after `least_s` and enough ticks with force.
FeltByTheClock disturbUntilFinished(const std::array<HardwareBench*, 2>& benches,
                                    const std::vector<device::Device>& devices, double least_s, std::uint64_t enough,
                                    LoopLinks& links) {
  FeltByTheClock felt;
  Random random(5);
  const auto started = Clock::now();
  double tended_s = -1.0;
  while (!links.finished.load()) {
    const double now_s = secondsSince(started);
    for (HardwareBench* bench : benches) disturb(*bench, now_s, random);
    if (now_s - tended_s > 0.5) {
      device::reviveDevices(devices);
      tended_s = now_s;
    }
    felt.drain(links);
    if (now_s > least_s && felt.with_force > enough) links.stop = true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return felt;
}

/// Drivers with loops of their own, a servo thread, and somebody who pulls cables: by the clock.
TEST(Soak, ByTheClockToo) {
  HardwareBench touch(device::openHapticsHardware());
  HardwareBench omega(device::forceDimensionHardware());
  const std::array<HardwareBench*, 2> benches = {&touch, &omega};
  for (HardwareBench* bench : benches) {
    bench->control().by_hand = false;
    bench->put({0, 0, 5});
  }
  const contact::Surface surface = lab::plateSurface(lab::PlateSettings{});
  const std::vector<device::Device> devices = {openOnItsOwnThread(touch), openOnItsOwnThread(omega)};
  Rig rig = rigByTheClock(surface, devices);
  LoopLinks links(2);
  // Where the machine is busy, most ticks fall into a time in which the rules hold the force back: then for longer.
  constexpr std::uint64_t kEnoughWithForce = 50;
  const double least_s = std::max(1.5, 0.1 * soakSeconds());
  const double most_s = least_s + 60.0;
  const auto most_ticks = static_cast<std::uint64_t>(1000.0 * most_s);
  LoopReport report;
  std::thread servo([&] { report = runPaced(rig, most_ticks, PacedSettings{}, links); });
  FeltByTheClock felt = disturbUntilFinished(benches, devices, least_s, kEnoughWithForce, links);
  servo.join();
  felt.drain(links);
  EXPECT_EQ(report.dropped_samples, 0u) << "else not every tick was judged";
  fmt::print("soak by the clock: {:.1f} s, {} ticks, {} overruns, {} stalls, lateness p99 {:.0f} us, {} with force\n",
             report.wall_s, report.ticks, report.overruns, report.stalls, report.lateness.p99_us, felt.with_force);
  EXPECT_GT(felt.with_force, kEnoughWithForce);
  EXPECT_LE(felt.largest_n, rig.fingers[0].limiter_settings.force_n * (1.0 + 1e-12));
  for (const device::Device& device : devices) device.close();
  for (HardwareBench* bench : benches) {
    EXPECT_EQ(bench->force(), Vec3::Zero());
    bench->control().by_hand = true;
  }
}

}  // namespace
}  // namespace palpate::servo
