// Paced: wake -> before_tick -> the tick between two readings of the clock -> rings and buffers -> once a second
// vitals. Headless: the same measured tick into a sink, with no clock to wait for. Neither allocates after the start; a
// wake that came too late is a fault for the limiter.
#include "palpate/servo/loop.h"

#include <algorithm>

#include "palpate/base/stopwatch.h"

namespace palpate::servo {

namespace {

/// Ticks between two progress reports of the headless loop: some milliseconds of work.
constexpr std::uint64_t kProgressTicks = 10000;

/// Ticks between two questions whether to stop.
constexpr std::uint64_t kStopTicks = 64;

/// Ticks of one LoopVitals.
constexpr std::uint64_t kVitalsTicks = 1000;

/// The last stretch of a running loop, for LoopVitals.
struct RecentMeter {
  DurationHistogram compute;
  DurationHistogram lateness;
  std::int64_t started_ns = monotonicNs();

  LoopVitals finished(const LoopReport& report) const {
    const double seconds = static_cast<double>(monotonicNs() - started_ns) * 1e-9;
    return {report.ticks,
            report.overruns,
            report.slow_ticks,
            report.stalls,
            compute.percentiles(),
            lateness.percentiles(),
            static_cast<double>(compute.count()) / seconds};
  }
};

/// The histograms and counters of a running loop; the report is made of them at the end.
struct Meter {
  DurationHistogram compute;
  DurationHistogram lateness;
  RecentMeter recent;
  std::int64_t started_ns = monotonicNs();
  LoopReport report;

  LoopReport finished() {
    report.compute = compute.percentiles();
    report.lateness = lateness.percentiles();
    report.wall_s = static_cast<double>(monotonicNs() - started_ns) * 1e-9;
    return report;
  }
};

void measuredTick(Rig& rig, std::uint64_t tick, LoopEvent event, TickSamples& samples, Meter& meter) {
  const std::int64_t before = monotonicNs();
  runTick(rig, tick, event, samples);
  const std::int64_t took = monotonicNs() - before;
  meter.compute.add(took);
  meter.recent.compute.add(took);
  if (static_cast<double>(took) > rig.tick_s * 1e9) ++meter.report.slow_ticks;
  ++meter.report.ticks;
}

LoopEvent recordWake(const Pacer::Wake& wake, const PacedSettings& settings, Meter& meter) {
  meter.lateness.add(wake.late_ns);
  meter.recent.lateness.add(wake.late_ns);
  if (static_cast<double>(wake.late_ns) <= settings.watchdog_s * 1e9) return LoopEvent::none;
  ++meter.report.stalls;
  return LoopEvent::stalled;
}

void publishSamples(const TickSamples& samples, LoopLinks& links) {
  for (const trace::Sample& sample : samples) links.samples.push(sample);
  if (links.records.load(std::memory_order_acquire)) {
    for (const trace::Sample& sample : samples) pushNumbered(links.record, sample, links.numbered);
  }
  links.contacts.publish(samples);
  links.heartbeat_ns.store(monotonicNs(), std::memory_order_relaxed);
}

void publishVitals(Meter& meter, LoopLinks& links) {
  if (meter.report.ticks % kVitalsTicks != 0) return;
  links.vitals.publish(meter.recent.finished(meter.report));
  meter.recent = RecentMeter{};
}

void releaseForces(Rig& rig) {
  for (FingerChain& finger : rig.fingers) {
    if (finger.device.write_force) finger.device.write_force(Vec3::Zero());
  }
}

}  // namespace

LoopReport runHeadless(Rig& rig, std::uint64_t ticks, const std::function<void(std::span<const trace::Sample>)>& sink,
                       const Progress& progress, const std::function<bool()>& stop) {
  TickSamples samples(rig.fingers.size());
  Meter meter;
  for (std::uint64_t tick = 0; tick < ticks; ++tick) {
    if (stop && tick % kStopTicks == 0 && stop()) break;
    measuredTick(rig, tick, LoopEvent::none, samples, meter);
    sink(samples);
    if (tick % kProgressTicks == 0) {
      palpate::report(progress, "palpating", static_cast<double>(tick) / static_cast<double>(ticks));
    }
  }
  return meter.finished();
}

LoopReport runPaced(Rig& rig, std::uint64_t ticks, const PacedSettings& settings, LoopLinks& links) {
  TickSamples samples(rig.fingers.size());
  Meter meter;
  meter.report.grant = prepareServoThread(settings.pacing);
  Pacer pacer(settings.pacing);
  rig.emergency_stop = &links.emergency_stop;
  for (std::uint64_t next = 0; next < ticks && !links.stop.load(std::memory_order_relaxed);) {
    const Pacer::Wake wake = pacer.waitForNext();
    const std::uint64_t tick = std::min(wake.tick, ticks - 1);
    meter.report.overruns += tick - next;  // deadlines past the end of the run do not count
    if (settings.before_tick) settings.before_tick(rig);
    measuredTick(rig, tick, recordWake(wake, settings, meter), samples, meter);
    publishSamples(samples, links);
    publishVitals(meter, links);
    next = tick + 1;
  }
  rig.emergency_stop = nullptr;
  releaseForces(rig);
  releaseServoMemory(meter.report.grant);
  meter.report.dropped_samples = links.samples.dropped();
  links.finished.store(true, std::memory_order_release);
  return meter.finished();
}

}  // namespace palpate::servo
