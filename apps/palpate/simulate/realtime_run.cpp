#include "apps/palpate/simulate/realtime_run.h"

#include <atomic>
#include <chrono>
#include <csignal>
#include <thread>

#include "palpate/base/stopwatch.h"
#include "palpate/engine/living_skin.h"

namespace palpate::app {

namespace {

constexpr double kFramesPerS = 60.0;

/// A lock-free atomic is what a signal handler may write.
std::atomic<bool> interrupted{false};

/// Turns Ctrl-C into a wish to stop, for as long as it lives.
class InterruptGuard {
 public:
  InterruptGuard() : previous_(std::signal(SIGINT, [](int) { interrupted = true; })) { interrupted = false; }
  ~InterruptGuard() { std::signal(SIGINT, previous_); }
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

 private:
  void (*previous_)(int);
};

/// The deformation beside the servo: newest contacts in, deformed skin out.
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

void displayUntilFinished(Display& display, servo::LoopLinks& links, double duration_s, const Progress& progress) {
  const auto started = Clock::now();
  const auto period = std::chrono::duration<double>(1.0 / kFramesPerS);
  for (int frame = 1; !links.finished.load(std::memory_order_acquire); ++frame) {
    if (interrupted) links.stop = true;
    display.drawFrame();
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
  const InterruptGuard guard;
  servo::LoopLinks links(rig.fingers.size());
  servo::PacedSettings settings;
  settings.pacing.period_s = rig.tick_s;
  Display display(world, links);
  servo::SampleDrain drain(links, sink);
  std::thread servo_thread([&] { report.loop = loop(rig, ticks, settings, links); });
  displayUntilFinished(display, links, static_cast<double>(ticks) * rig.tick_s, progress);
  servo_thread.join();
  drain.join();
  report.display = display.report();
  return report;
}

}  // namespace palpate::app
