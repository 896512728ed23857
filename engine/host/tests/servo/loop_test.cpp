#include "palpate/servo/loop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <thread>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/device/device.h"

namespace palpate::servo {
namespace {

/// A flat plate at z = 0, 200 mm wide, 0.5 N/mm.
contact::Surface plate() {
  mesh::TriangleMesh mesh;
  mesh.positions = {Vec3(-100, -100, 0), Vec3(100, -100, 0), Vec3(100, 100, 0), Vec3(-100, 100, 0)};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return contact::buildSurface(mesh, std::vector<double>(4, 0.5));
}

/// Presses 4 mm deep, then slides.
std::shared_ptr<const std::vector<Vec3>> pressAndSlide(std::size_t ticks, double y_mm) {
  std::vector<Vec3> tips;
  for (std::size_t k = 0; k < ticks; ++k) {
    const double t = static_cast<double>(k) / static_cast<double>(ticks);
    tips.emplace_back(-20.0 + 40.0 * t, y_mm, std::max(-4.0, 2.0 - 20.0 * t));
  }
  return std::make_shared<const std::vector<Vec3>>(std::move(tips));
}

Rig makeRig(const contact::Surface& surface, std::size_t ticks) {
  Rig rig;
  FingerSolvers solvers = makeSolvers(surface, nullptr, 2);
  for (const double y_mm : {-30.0, 30.0}) {
    FingerChain finger;
    finger.solver = std::move(solvers[rig.fingers.size()]);
    finger.device = device::scriptedDevice("scripted", pressAndSlide(ticks, y_mm));
    rig.fingers.push_back(std::move(finger));
  }
  return rig;
}

PacedSettings quick() {
  PacedSettings settings;
  settings.pacing.realtime = false;  // the tests must not need privileges
  return settings;
}

TEST(Tick, GivesContactForceToTheTraceAndASafeForceToTheDevice) {
  const contact::Surface surface = plate();
  Rig rig = makeRig(surface, 10);
  Vec3 written = Vec3::Zero();
  rig.fingers[0].device.read_tip = [](std::uint64_t tick) { return Vec3(0, 0, tick == 0 ? 1.0 : -20.0); };
  rig.fingers[0].device.write_force = [&](const Vec3& force) { written = force; };
  std::vector<trace::Sample> samples(2);
  for (std::uint64_t tick = 0; tick < 5; ++tick) runTick(rig, tick, LoopEvent::none, samples);
  EXPECT_NEAR(samples[0].contact.force.z(), 10.0, 1e-9);
  EXPECT_EQ(written, samples[0].device_force);
  EXPECT_LE(written.norm(), 3.3);
  EXPECT_NE(samples[0].safety, 0u);
}

TEST(Tick, ADeviceWithoutPositionGivesNoNumberToNobody) {
  const contact::Surface surface = plate();
  Rig rig = makeRig(surface, 10);
  rig.fingers[0].device.read_tip = [](std::uint64_t) {
    return Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  };
  std::vector<trace::Sample> samples(2);
  runTick(rig, 0, LoopEvent::none, samples);
  EXPECT_TRUE(samples[0].safety & kTipNotFinite);
  EXPECT_TRUE(samples[0].contact.tip.allFinite());
  EXPECT_TRUE(samples[0].device_force.isZero());
}

TEST(HeadlessLoop, RunsEveryTickOfEveryFingerInOrder) {
  const contact::Surface surface = plate();
  Rig rig = makeRig(surface, 500);
  std::uint64_t expected = 0;
  double peak = 0.0;
  const LoopReport report = runHeadless(rig, 500, [&](std::span<const trace::Sample> samples) {
    ASSERT_EQ(samples.size(), 2u);
    EXPECT_EQ(samples[0].tick, expected++);
    EXPECT_EQ(samples[1].finger, 1u);
    peak = std::max(peak, samples[1].contact.force.z());
  });
  EXPECT_EQ(report.ticks, 500u);
  EXPECT_NEAR(peak, 2.0, 1e-9);
  EXPECT_GT(report.compute.p50_us, 0.0);
}

TEST(HeadlessLoop, CountsTheTicksThatTookLongerThanATick) {
  const contact::Surface surface = plate();
  const auto slow_ticks = [&](double tick_s) {
    Rig rig = makeRig(surface, 50);
    rig.tick_s = tick_s;
    return runHeadless(rig, 50, [](std::span<const trace::Sample>) {}).slow_ticks;
  };
  EXPECT_EQ(slow_ticks(100.0), 0u);
  EXPECT_EQ(slow_ticks(1e-12), 50u);
}

TEST(HeadlessLoop, GivesTheSameBitsTwice) {
  const contact::Surface surface = plate();
  const auto forces = [&] {
    Rig rig = makeRig(surface, 500);
    std::vector<Vec3> all;
    runHeadless(rig, 500, [&](std::span<const trace::Sample> samples) {
      for (const trace::Sample& s : samples) {
        all.push_back(s.contact.force);
        all.push_back(s.device_force);
      }
    });
    return all;
  };
  const std::vector<Vec3> once = forces();
  EXPECT_EQ(once.size(), 500u * 2u * 2u) << "of the contact and for the device, of two fingers in every tick";
  EXPECT_EQ(forces(), once);
}

// Also the test that ThreadSanitizer watches: servo, writer and display each on a thread of their own.
TEST(PacedLoop, FeedsWriterAndDisplayBesideTheServo) {
  const contact::Surface surface = plate();
  constexpr std::uint64_t kTicks = 400;
  Rig rig = makeRig(surface, kTicks);
  LoopLinks links(rig.fingers.size());
  std::vector<trace::Sample> written;
  SampleDrain drain(links, [&](const trace::Sample& sample) { written.push_back(sample); });
  LoopReport report;
  std::thread servo([&] { report = runPaced(rig, kTicks, quick(), links); });
  std::uint64_t newest = 0;
  while (!links.finished.load()) {
    const TickSamples& frame = links.contacts.newest();
    EXPECT_EQ(frame[0].tick, frame[1].tick) << "a frame is one tick of all fingers";
    EXPECT_GE(frame[0].tick, newest);
    newest = frame[0].tick;
    std::this_thread::sleep_for(std::chrono::milliseconds(16));
  }
  servo.join();
  drain.join();
  EXPECT_EQ(report.ticks + report.overruns, kTicks);
  EXPECT_EQ(written.size(), 2 * report.ticks);
  EXPECT_EQ(report.dropped_samples, 0u);
  EXPECT_EQ(links.contacts.newest()[0].tick, kTicks - 1);
  EXPECT_GE(report.wall_s, 0.4);
  EXPECT_GE(report.lateness.max_us, report.lateness.p50_us);
  EXPECT_NE(links.heartbeat_ns.load(), 0);
}

TEST(PacedLoop, StopsWhenAskedAndLetsGoOfEveryDevice) {
  const contact::Surface surface = plate();
  Rig rig = makeRig(surface, 100);
  LoopLinks links(rig.fingers.size());
  std::array<Vec3, 2> last_force;
  std::array<double, 2> largest_n{};
  for (std::size_t i = 0; i < 2; ++i) {
    rig.fingers[i].device.write_force = [&, i](const Vec3& force) {
      last_force[i] = force;
      largest_n[i] = std::max(largest_n[i], force.norm());
      if (std::min(largest_n[0], largest_n[1]) > 0.2) links.stop = true;
    };
  }
  const LoopReport report = runPaced(rig, 1'000'000, quick(), links);
  EXPECT_LT(report.ticks, 100'000u);
  EXPECT_GT(std::min(largest_n[0], largest_n[1]), 0.2) << "it stopped while they pressed";
  EXPECT_EQ(last_force[0], Vec3::Zero());
  EXPECT_EQ(last_force[1], Vec3::Zero());
  EXPECT_TRUE(links.finished.load());
}

TEST(PacedLoop, SaysHowManySamplesNobodyTook) {
  const contact::Surface surface = plate();
  Rig rig = makeRig(surface, 100);
  LoopLinks links(rig.fingers.size(), 4);
  PacedSettings settings = quick();
  std::uint64_t ticks = 0;
  settings.before_tick = [&](Rig&) { links.stop = ++ticks == 20; };
  EXPECT_GE(runPaced(rig, 1'000'000, settings, links).dropped_samples, 2u * 20u - 4u);
}

TEST(PacedLoop, SendsNoForceAfterTheEmergencyStop) {
  const contact::Surface surface = plate();
  Rig rig = makeRig(surface, 100);
  LoopLinks links(rig.fingers.size());
  std::uint64_t ticks = 0;
  std::uint64_t pushed = 0;
  rig.fingers[0].device.read_tip = [&](std::uint64_t) { return Vec3(0, 0, ticks < 5 ? 0.1 : -0.05); };
  rig.fingers[0].device.write_force = [&](const Vec3& force) {
    if (ticks == 20) links.emergency_stop.press();  // holds from the next tick on
    if (ticks <= 20) pushed += force.isZero() ? 0 : 1;
    if (ticks > 20) {
      EXPECT_TRUE(force.isZero()) << ticks;
    }
    if (++ticks == 60) links.stop = true;
  };
  runPaced(rig, 1'000'000, quick(), links);
  EXPECT_GT(pushed, 10u);
  EXPECT_GT(rig.fingers[0].limiter.counts[11], 30u);
}

TEST(PacedLoop, CallsAStallAFault) {
  const contact::Surface surface = plate();
  Rig rig = makeRig(surface, 100);
  LoopLinks links(rig.fingers.size());
  bool slept = false;
  rig.fingers[0].device.read_tip = [&slept](std::uint64_t tick) {
    // Not "at tick 20": a busy machine may skip that one.
    if (tick >= 20 && !std::exchange(slept, true)) std::this_thread::sleep_for(std::chrono::milliseconds(80));
    return Vec3(0, 0, 1);
  };
  std::uint32_t seen = 0;
  SampleDrain drain(links, [&](const trace::Sample& sample) { seen |= sample.safety; });
  const LoopReport report = runPaced(rig, 400, quick(), links);
  drain.join();
  EXPECT_GE(report.stalls, 1u);
  EXPECT_GE(report.overruns, 50u);
  EXPECT_TRUE(seen & kStalled);
}

TEST(PacedLoop, LetsTheServoThreadExchangeItsSurfaceBetweenTicks) {
  const contact::Surface surface = plate();
  const contact::Surface other = plate();
  Rig rig = makeRig(surface, 100);
  LoopLinks links(rig.fingers.size());
  PacedSettings settings = quick();
  std::uint64_t calls = 0;
  settings.before_tick = [&](Rig& ours) {
    if (++calls == 50) ours.fingers[0].solver.source.surface = &other;
  };
  const LoopReport report = runPaced(rig, 100, settings, links);
  EXPECT_EQ(calls, report.ticks);
  EXPECT_EQ(rig.fingers[0].solver.source.surface, calls >= 50 ? &other : &surface);
}

TEST(PacedLoop, PublishesItsVitalsEveryThousandTicks) {
  const contact::Surface surface = plate();
  Rig rig = makeRig(surface, 100);
  LoopLinks links(rig.fingers.size());
  PacedSettings settings = quick();
  settings.before_tick = [&](Rig&) {
    if (links.vitals.newest().ticks > 0) links.stop = true;
  };
  runPaced(rig, 100'000, settings, links);
  const LoopVitals vitals = links.vitals.newest();
  EXPECT_EQ(vitals.ticks, 1000u);
  EXPECT_GT(vitals.ticks_per_s, 100.0);  // as slow as a busy machine, but no tick comes before its time
  EXPECT_LT(vitals.ticks_per_s, 1020.0);
  EXPECT_GT(vitals.compute.p50_us, 0.0);
  EXPECT_GT(vitals.lateness.max_us, 0.0);
  EXPECT_GE(vitals.lateness.max_us, vitals.lateness.p99_us);
}

TEST(SampleDrain, HandsOverWhatItsSinkThrew) {
  LoopLinks links(1);
  links.samples.push({});
  SampleDrain drain(links, [](const trace::Sample&) { throw Error("disk full"); });
  links.finished = true;
  EXPECT_THROW(drain.join(), Error);
}

}  // namespace
}  // namespace palpate::servo
