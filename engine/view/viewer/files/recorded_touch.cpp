#include "view/viewer/files/recorded_touch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "palpate/base/language.h"
#include "palpate/device/finger_path.h"
#include "palpate/servo/tick.h"
#include "palpate/trace/forces_table.h"
#include "view/viewer/world/live_servo.h"

namespace palpate::viewer {

namespace {

/// No hand moves this far in a tick, mm: the finger was put elsewhere, and forgets its contact.
constexpr double kJumpMm = 40.0;

/// All fingers on one clock: a finger without a row at a time was nowhere.
struct RecordedTips {
  std::vector<double> time_s;
  std::vector<std::string> names;
  std::vector<std::vector<Vec3>> tips;  ///< one list per finger, one entry per time
};

/// By the shortest step: a late tick was left out, and leaves a longer one.
double ticksPerS(const std::vector<double>& time_s, double fallback) {
  double shortest_s = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < time_s.size(); ++i) shortest_s = std::min(shortest_s, time_s[i] - time_s[i - 1]);
  return std::isfinite(shortest_s) ? std::max(1.0, std::round(1.0 / shortest_s)) : fallback;
}

/// The window's own fingers keep their places, also when the right one was put on the body first or alone.
void sortHands(std::vector<trace::RecordedFinger>& fingers) {
  const auto is = [](std::string_view name) { return [=](const trace::RecordedFinger& f) { return f.name == name; }; };
  const auto right = std::find_if(fingers.begin(), fingers.end(), is(kFingerNames[1]));
  if (right == fingers.end()) return;
  if (fingers.size() == 1) fingers.insert(fingers.begin(), {std::string(kFingerNames[0]), {}, {}, {}});
  if (fingers.size() == 2 && is(kFingerNames[0])(fingers[1])) std::swap(fingers[0], fingers[1]);
}

RecordedTips mergeTips(std::vector<trace::RecordedFinger> fingers) {
  sortHands(fingers);
  if (fingers.size() > kFingers) fingers.resize(kFingers);
  RecordedTips recorded;
  std::vector<double>& times = recorded.time_s;
  for (const trace::RecordedFinger& f : fingers) times.insert(times.end(), f.time_s.begin(), f.time_s.end());
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  for (const trace::RecordedFinger& finger : fingers) {
    recorded.names.push_back(finger.name);
    std::vector<Vec3>& tips = recorded.tips.emplace_back(times.size(), device::kNowhere);
    std::size_t row = 0;
    for (std::size_t i = 0; i < times.size() && row < finger.time_s.size(); ++i) {
      if (finger.time_s[row] == times[i]) tips[i] = finger.tip[row++];
    }
  }
  return recorded;
}

/// Reads the current row; ticks that were left out have none.
servo::Rig rigFor(engine::ServoPlan& plan, const RecordedTips& of, double ticks_per_s, const std::size_t& row) {
  servo::RigParts parts{.solvers = std::move(plan.solvers),
                        .fingers = std::move(plan.fingers),
                        .devices = {},
                        .limiter = plan.limiter,
                        .tick_s = 1.0 / ticks_per_s};
  parts.fingers.resize(of.tips.size());
  for (std::size_t f = 0; f < of.tips.size(); ++f) {
    const auto tip = [&tips = of.tips[f], &row](std::uint64_t) { return tips[std::min(row, tips.size() - 1)]; };
    parts.devices.push_back({of.names[f], tip, {}});
  }
  return servo::rigOf(std::move(parts));
}

bool jumps(const std::vector<Vec3>& tips, std::size_t row) {
  return row > 0 && (tips[row] - tips[row - 1]).norm() > kJumpMm;
}

void touch(engine::ServoPlan& plan, const RecordedTips& of, RecordedTouch& recorded, const Progress& progress) {
  constexpr std::size_t kBetweenReports = 4096;  // ticks
  std::size_t row = 0;
  servo::Rig rig = rigFor(plan, of, recorded.ticks_per_s, row);
  std::vector<trace::Sample> samples(of.tips.size());
  const double begin_s = std::min(0.0, of.time_s.front());  // the table's own times, but none before the first tick
  for (; row < of.time_s.size(); ++row) {
    if (row % kBetweenReports == 0) {
      report(progress, "replaying the touch", static_cast<double>(row) / static_cast<double>(of.time_s.size()));
    }
    for (std::size_t f = 0; f < of.tips.size(); ++f) {
      if (jumps(of.tips[f], row)) engine::forgetTouch(rig.fingers[f]);
    }
    servo::runTick(rig, row, servo::LoopEvent::none, samples);
    const double since_s = of.time_s[row] - begin_s;
    for (trace::Sample& sample : samples) {
      sample.tick = static_cast<std::uint64_t>(std::llround(since_s * recorded.ticks_per_s));
      recorded.history.add(sample);
    }
  }
}

}  // namespace

RecordedTouch touchedAgain(const std::shared_ptr<const scene::World>& world, const scene::Scene& scene,
                           const std::filesystem::path& table, const Progress& progress) {
  const RecordedTips tips = mergeTips(trace::readForcesTable(table));
  RecordedTouch recorded;
  recorded.file = table.string();
  recorded.ticks_per_s = ticksPerS(tips.time_s, scene.ticks_per_s);
  const double seconds = static_cast<double>(tips.time_s.size()) / recorded.ticks_per_s;
  recorded.history = TouchHistory(recorded.ticks_per_s, std::min(seconds, kLongestReplayS));
  engine::ServoPlan plan = planFor(world, scene, true);
  for (std::size_t i = 0; i < tips.tips.size(); ++i) recorded.radius_mm.push_back(fingerRadius(scene, i));
  touch(plan, tips, recorded, progress);
  return recorded;
}

RecordedTouch touchOfScript(const std::shared_ptr<const scene::World>& world, const Progress& progress) {
  const scene::Scene& scene = world->scene;
  const device::FingerPaths paths = device::pathsOf(*world);
  RecordedTouch recorded;
  recorded.file = tr("the scene's fingers");
  recorded.of_script = true;
  recorded.ticks_per_s = scene.ticks_per_s;
  RecordedTips tips;
  for (std::size_t tick = 0; tick < paths.ticks; ++tick) {
    tips.time_s.push_back(static_cast<double>(tick) / scene.ticks_per_s);
  }
  engine::ServoPlan plan = planFor(world, scene, true);
  for (std::size_t i = 0; i < std::min(kFingers, scene.fingers.size()); ++i) {
    const scene::Finger& scripted = scene.fingers[i];
    plan.fingers[i] = scene::contactSettings(scene, scripted);
    recorded.radius_mm.push_back(scripted.radius_mm);
    tips.names.push_back(scripted.name);
    tips.tips.push_back(*paths.tips[i]);
    tips.tips.back().resize(paths.ticks, tips.tips.back().back());
  }
  const double seconds = static_cast<double>(paths.ticks) / recorded.ticks_per_s;
  recorded.history = TouchHistory(recorded.ticks_per_s, std::min(seconds, kLongestReplayS));
  touch(plan, tips, recorded, progress);
  return recorded;
}

namespace {

/// Thrown from a progress report to cancel the read.
struct GivenUp {};

}  // namespace

bool ReplayLoader::load(std::function<RecordedTouch(const Progress& progress)> read) {
  if (work_) return false;
  result_ = {};
  cancelled_ = false;
  began_ = Clock::now();
  progress_ = {.stage = toTranslate("reading the recording")};
  work_.emplace([this, read = std::move(read)] {
    try {
      result_.touch = read([this](std::string_view stage, double done) { note(stage, done); });
    } catch (const GivenUp&) {
    } catch (const std::exception& error) {
      result_.error = error.what();
    }
  });
  return true;
}

void ReplayLoader::note(std::string_view stage, double done) {
  if (cancelled_) throw GivenUp();
  const std::lock_guard lock(mutex_);
  progress_.stage = stage;
  progress_.done = done;
}

std::optional<engine::BuildProgress> ReplayLoader::progress() const {
  if (!work_ || cancelled_) return std::nullopt;
  const std::lock_guard lock(mutex_);
  engine::BuildProgress now = progress_;
  now.since_s = secondsSince(began_);
  return now;
}

std::optional<ReplayLoader::Result> ReplayLoader::collectResult() {
  if (!work_ || !work_->done()) return std::nullopt;
  work_->join();
  work_.reset();
  if (cancelled_) return std::nullopt;
  return std::move(result_);
}

}  // namespace palpate::viewer
