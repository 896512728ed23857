// The hand-over is timed in blocks that alternate with blocks without it, on the same rig, while a writer takes the
// samples out on another thread as it does for a hand. The long recording repeats the recorded ticks.
#include "lab/runs/recording_run.h"

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include "lab/counters/statistics.h"
#include "palpate/base/random.h"
#include "palpate/base/stopwatch.h"
#include "palpate/engine/recording_replay.h"
#include "palpate/engine/recording_settings.h"
#include "palpate/servo/loop.h"
#include "palpate/servo/scripted_rig.h"

namespace palpate::bench {

namespace {

/// Short enough that an interruption of the system spoils few, long enough for the clock.
constexpr std::uint64_t kRecordedTicks = 250;

std::vector<trace::RecordingFinger> makeRecordingFingers(const scene::World& world) {
  std::vector<trace::RecordingFinger> fingers;
  for (const scene::Finger& finger : world.scene.fingers) fingers.push_back({finger.name, "script"});
  return fingers;
}

/// Ticks of the paths, from their beginning whenever they end, with fingers that forget their contacts there.
class Ticks {
 public:
  Ticks(const scene::World& world, const device::FingerPaths& paths)
      : rig_(servo::scriptedRig(world, paths)), length_(paths.ticks), samples_(rig_.fingers.size()) {
    std::size_t number = 0;
    for (servo::FingerChain& finger : rig_.fingers) {
      const auto tips = paths.tips[number++];
      finger.device.read_tip = [tips, length = length_](std::uint64_t tick) {
        return (*tips)[std::min<std::uint64_t>(tick % length, tips->size() - 1)];
      };
    }
  }

  const servo::TickSamples& next() {
    if (at_ % length_ == 0) {
      for (servo::FingerChain& finger : rig_.fingers) servo::forgetTouch(finger);
    }
    servo::runTick(rig_, at_++, servo::LoopEvent::none, samples_);
    return samples_;
  }
  const servo::Rig& rig() const { return rig_; }

 private:
  servo::Rig rig_;
  std::uint64_t length_;
  std::uint64_t at_ = 0;
  servo::TickSamples samples_;
};

/// Takes the samples out of the ring and writes them, as engine::Recorder does.
class Drain {
 public:
  Drain(servo::LoopLinks& links, trace::RecordingWriter& writer)
      : thread_([this, &links, &writer] {
          servo::NumberedSample sample;
          while (!ends_ || !idle_) {
            idle_ = true;
            while (links.record.pop(sample)) {
              idle_ = false;
              writer.add(sample.sample);
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
          }
        }) {}
  ~Drain() {
    ends_ = true;
    thread_.join();
  }
  Drain(const Drain&) = delete;
  Drain& operator=(const Drain&) = delete;
  void waitUntilIdle() const {
    while (!idle_) std::this_thread::yield();
  }

 private:
  std::atomic<bool> ends_{false};
  std::atomic<bool> idle_{true};
  std::thread thread_;
};

/// Adds its costs; returns the number of samples that were dropped.
std::uint64_t measureHandOver(const scene::World& world, const device::FingerPaths& paths,
                              const RecordingRunSettings& settings, Json& json) {
  constexpr double kMeasuredS = 3.0;
  trace::RecordingWriter writer(settings.folder / "hand_over.session", engine::recordingHeader(world.scene.ticks_per_s),
                                makeRecordingFingers(world));
  servo::LoopLinks links(world.scene.fingers.size(), std::size_t{1} << 16, servo::kRecordCapacity);
  Ticks ticks(world, paths);
  std::vector<double> with;
  std::vector<double> without;
  {
    Drain drain(links, writer);
    const auto block = [&](bool records) {
      const auto start = Clock::now();
      for (std::uint64_t k = 0; k < kRecordedTicks; ++k) {
        const servo::TickSamples& samples = ticks.next();
        if (!records) continue;
        for (const trace::Sample& sample : samples) servo::pushNumbered(links.record, sample, links.numbered);
      }
      const double us = microsecondsSince(start) / static_cast<double>(kRecordedTicks);
      drain.waitUntilIdle();
      return us;
    };
    for (const auto started = Clock::now(); secondsSince(started) < kMeasuredS || with.empty();) {
      with.push_back(block(true));
      without.push_back(block(false));
    }
  }
  const double tick_us = lab::computePercentiles(without).p50;
  const double record_us = lab::computePercentiles(with).p50 - tick_us;
  json["record_us_per_tick"] = record_us;
  json["tick_us"] = tick_us;
  json["record_ratio"] = record_us / tick_us;
  json["blocks"] = with.size();
  writer.discard();
  return links.record.dropped();
}

void record(const scene::World& world, const device::FingerPaths& paths, const RecordingRunSettings& settings,
            Json& json) {
  const std::filesystem::path file = settings.folder / "short.session";
  const double rate = world.scene.ticks_per_s;
  const auto count = static_cast<std::uint64_t>(settings.seconds * rate);
  Ticks ticks(world, paths);
  trace::RecordingWriter writer(file, engine::recordingHeader(rate), makeRecordingFingers(world));
  writer.add(engine::recordingWorld(world, engine::feltWith(ticks.rig())));
  double written_s = 0.0;
  for (std::uint64_t k = 0; k < count; ++k) {
    const servo::TickSamples& samples = ticks.next();
    const auto start = Clock::now();
    for (const trace::Sample& sample : samples) writer.add(sample);
    written_s += secondsSince(start);
  }
  const auto start = Clock::now();
  writer.finish("done");
  written_s += secondsSince(start);
  const auto bytes = static_cast<double>(std::filesystem::file_size(file));
  json["bytes_per_tick"] = bytes / static_cast<double>(count);
  json["write_mb_per_s"] = 1e-6 * bytes / settings.seconds;  // of simulated time
  json["write_times_real_time"] = settings.seconds / written_s;
  trace::RecordingReader recording(file);
  const auto replaying = Clock::now();
  const engine::ReplayReport report = engine::replay(recording);
  json["replay_times_real_time"] = settings.seconds / (secondsSince(replaying) - report.build_s);
  json["identical"] = report.identical();
}

/// A recording of the long kind: the same part again and again, at its own time.
void writeLong(const scene::World& world, const RecordingRunSettings& settings, const Progress& progress) {
  std::vector<trace::Sample> part;
  trace::RecordingReader recording(settings.folder / "short.session");
  const double rate = world.scene.ticks_per_s;
  recording.forEachTick({0, static_cast<std::uint64_t>(rate) - 1}, [&](std::span<const trace::Sample> samples) {
    part.insert(part.end(), samples.begin(), samples.end());
    return true;
  });
  trace::RecordingWriter writer(settings.folder / "long.session", engine::recordingHeader(rate),
                                makeRecordingFingers(world));
  const auto parts = static_cast<std::uint64_t>(3600.0 * settings.long_hours);
  for (std::uint64_t i = 0; i < parts; ++i) {
    if (i % 60 == 0) report(progress, "writing a long recording", static_cast<double>(i) / static_cast<double>(parts));
    for (trace::Sample sample : part) {
      sample.tick += i * static_cast<std::uint64_t>(rate);
      writer.add(sample);
    }
  }
  writer.finish("done");
}

void measureSearch(const RecordingRunSettings& settings, Json& json) {
  constexpr int kSearches = 20;
  const std::filesystem::path file = settings.folder / "long.session";
  json["long_hours"] = settings.long_hours;
  json["long_mb"] = 1e-6 * static_cast<double>(std::filesystem::file_size(file));
  Random random(1);
  double open_s = 0.0, seek_s = 0.0;
  for (int i = 0; i < kSearches; ++i) {
    const auto start = Clock::now();
    trace::RecordingReader recording(file);
    open_s = std::max(open_s, secondsSince(start));
    const auto from = static_cast<std::uint64_t>(random.uniform() * static_cast<double>(recording.facts().last_tick));
    recording.forEachTick({from}, [](auto) { return false; });
    seek_s = std::max(seek_s, secondsSince(start));
  }
  json["open_s"] = open_s;
  json["seek_s"] = seek_s;
}

}  // namespace

Json measureRecording(const scene::World& world, const device::FingerPaths& paths, const RecordingRunSettings& settings,
                      const Progress& progress) {
  Json json = {{"fingers", world.scene.fingers.size()}};
  report(progress, "handing ticks over", 0.0);
  const std::uint64_t dropped = measureHandOver(world, paths, settings, json);
  report(progress, "recording and feeling again", 0.3);
  record(world, paths, settings, json);
  writeLong(world, settings, progress);
  measureSearch(settings, json);
  json["dropped"] = dropped;
  return json;
}

}  // namespace palpate::bench
