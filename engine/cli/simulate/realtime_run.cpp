#include "cli/simulate/realtime_run.h"

#include <chrono>
#include <span>
#include <thread>
#include <vector>

#include "cli/kit/interruption.h"
#include "palpate/base/stopwatch.h"
#include "palpate/device/back_ends.h"
#include "palpate/engine/living_skin.h"

namespace palpate::app {

namespace {

constexpr double kFramesPerS = 60.0;

/// Stops the loop and waits for it, even after an exception.
class JoinedAtTheEnd {
 public:
  JoinedAtTheEnd(std::thread& thread, servo::LoopLinks& links) : thread_(thread), links_(links) {}
  ~JoinedAtTheEnd() {
    if (!thread_.joinable()) return;
    links_.stop = true;
    thread_.join();
  }
  JoinedAtTheEnd(const JoinedAtTheEnd&) = delete;
  JoinedAtTheEnd& operator=(const JoinedAtTheEnd&) = delete;

 private:
  std::thread& thread_;
  servo::LoopLinks& links_;
};

/// The deformation next to the servo: newest contacts in, deformed skin out.
class Display {
 public:
  Display(const scene::World& world, servo::LoopLinks& links) : links_(links), skin_(world) {}

  void drawFrame() {
    const std::int64_t before = monotonicNs();
    const servo::TickSamples& newest = links_.contacts.newest();
    const std::int64_t published = links_.heartbeat_ns.load(std::memory_order_relaxed);
    if (published != 0) staleness_.add(before - published);
    skin_.follow(newest);
    durations_.add(monotonicNs() - before);
  }

  DisplayReport report() const {
    return {durations_.count(), 1e3 / kFramesPerS, durations_.percentiles(), staleness_.percentiles()};
  }

 private:
  servo::LoopLinks& links_;
  engine::LivingSkin skin_;
  servo::DurationHistogram durations_;
  servo::DurationHistogram staleness_;
};

/// Lost devices are looked for once a second: that may take the driver a moment.
constexpr int kFramesPerLook = 60;

void displayUntilFinished(Display& display, servo::LoopLinks& links, std::span<const device::Device> devices,
                          double duration_s, const Progress& progress) {
  const auto started = Clock::now();
  const auto period = std::chrono::duration<double>(1.0 / kFramesPerS);
  for (int frame = 1; !links.finished.load(std::memory_order_acquire); ++frame) {
    if (endingSignal() != 0) links.stop = true;
    display.drawFrame();
    if (frame % kFramesPerLook == 0) device::reviveDevices(devices);
    const auto due = started + std::chrono::duration_cast<Clock::duration>(frame * period);
    const double elapsed_s = secondsSince(started);
    report(progress, "palpating in real time", std::min(1.0, elapsed_s / duration_s));
    std::this_thread::sleep_until(due);
  }
}

}  // namespace

RealtimeReport runRealtime(const scene::World& world, servo::Rig& rig, std::uint64_t ticks,
                           const servo::SampleDrain::Sink& sink, const Progress& progress, const ServoLoop& loop) {
  RealtimeReport report;
  const FinishesInOrder in_order;
  servo::LoopLinks links(rig.fingers.size());
  const StoppedBySignal stopped(links.emergency_stop);
  std::vector<device::Device> devices;
  for (const servo::FingerChain& finger : rig.fingers) devices.push_back(finger.device);
  servo::PacedSettings settings;
  settings.pacing.period_s = rig.tick_s;
  Display display(world, links);
  servo::SampleDrain drain(links, sink);
  std::thread servo_thread([&] { report.loop = loop(rig, ticks, settings, links); });
  const JoinedAtTheEnd joined(servo_thread, links);
  displayUntilFinished(display, links, devices, static_cast<double>(ticks) * rig.tick_s, progress);
  servo_thread.join();
  drain.join();
  report.display = display.report();
  return report;
}

}  // namespace palpate::app
