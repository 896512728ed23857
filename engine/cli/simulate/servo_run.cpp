#include "cli/simulate/realtime_run.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "palpate/base/stopwatch.h"
#include "palpate/device/finger_path.h"
#include "palpate/servo/scripted_rig.h"

namespace palpate::app {

namespace {

using Tips = std::shared_ptr<const std::vector<Vec3>>;

Tips repeated(const std::vector<Vec3>& tips, std::size_t ticks) {
  auto all = std::make_shared<std::vector<Vec3>>();
  all->reserve(ticks);
  for (std::size_t k = 0; k < ticks; ++k) all->push_back(tips[k % tips.size()]);
  return all;
}

device::FingerPaths pathsFor(const scene::World& world, double seconds) {
  device::FingerPaths paths = device::pathsOf(world);
  const auto ticks = static_cast<std::size_t>(std::max(1.0, std::round(seconds * world.scene.ticks_per_s)));
  for (Tips& tips : paths.tips) tips = repeated(*tips, ticks);
  paths.ticks = ticks;
  return paths;
}

}  // namespace

RealtimeReport measureServo(const scene::World& world, double seconds, const Progress& progress,
                            const ServoLoop& loop) {
  const device::FingerPaths paths = pathsFor(world, seconds);
  servo::Rig rig = servo::scriptedRig(world, paths);
  return runRealtime(
      world, rig, paths.ticks, [](const trace::Sample&) {}, progress, loop);
}

servo::LoopReport runSleepUntil(servo::Rig& rig, std::uint64_t ticks, const servo::PacedSettings& settings,
                                servo::LoopLinks& links) {
  const auto period = std::chrono::nanoseconds(std::llround(settings.pacing.period_s * 1e9));
  servo::TickSamples samples(rig.fingers.size());
  servo::DurationHistogram lateness, compute;
  servo::LoopReport report;
  report.grant.note = "nothing asked for";
  const Clock::time_point start = Clock::now();
  for (; report.ticks < ticks && !links.stop.load(std::memory_order_relaxed); ++report.ticks) {
    const Clock::time_point due = start + static_cast<std::int64_t>(report.ticks + 1) * period;
    std::this_thread::sleep_until(due);
    const Clock::time_point woken = Clock::now();
    servo::runTick(rig, report.ticks, servo::LoopEvent::none, samples);
    compute.add((Clock::now() - woken) / std::chrono::nanoseconds(1));
    lateness.add((woken - due) / std::chrono::nanoseconds(1));
    if (woken - due >= period) ++report.overruns;
    for (const trace::Sample& sample : samples) links.samples.push(sample);
    links.contacts.publish(samples);
  }
  links.finished.store(true, std::memory_order_release);
  report.compute = compute.percentiles();
  report.lateness = lateness.percentiles();
  report.wall_s = secondsSince(start);
  return report;
}

std::string describeScheduler(const servo::PacingGrant& grant) {
  return grant.realtime ? fmt::format("SCHED_FIFO {}", servo::PacingSettings{}.realtime_priority) : "SCHED_OTHER";
}

}  // namespace palpate::app
