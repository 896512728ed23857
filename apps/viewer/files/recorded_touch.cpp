#include "apps/viewer/files/recorded_touch.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "palpate/servo/tick.h"
#include "palpate/trace/forces_table.h"

namespace palpate::viewer {

namespace {

/// No hand moves so far in a tick, mm: the finger was put elsewhere, and forgets what it touched.
constexpr double kJumpMm = 40.0;

/// By the shortest step: a tick that came too late was left out, and leaves a longer one.
double ticksPerS(const trace::RecordedFinger& finger, double fallback) {
  double shortest_s = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < finger.time_s.size(); ++i) {
    shortest_s = std::min(shortest_s, finger.time_s[i] - finger.time_s[i - 1]);
  }
  return std::isfinite(shortest_s) ? std::max(1.0, std::round(1.0 / shortest_s)) : fallback;
}

/// Reads the row that is at work; ticks that were left out have none.
servo::Rig rigFor(engine::ServoPlan& plan, const std::vector<trace::RecordedFinger>& fingers, double ticks_per_s,
                  const std::size_t& row) {
  servo::RigParts parts{.solvers = std::move(plan.solvers),
                        .fingers = std::move(plan.fingers),
                        .devices = {},
                        .limiter = plan.limiter,
                        .tick_s = 1.0 / ticks_per_s};
  parts.fingers.resize(fingers.size());
  for (const trace::RecordedFinger& finger : fingers) {
    const auto tip = [&tips = finger.tip, &row](std::uint64_t) { return tips[std::min(row, tips.size() - 1)]; };
    parts.devices.push_back({finger.name, tip, {}});
  }
  return servo::rigOf(std::move(parts));
}

bool jumps(const trace::RecordedFinger& finger, std::size_t row) {
  return row > 0 && row < finger.tip.size() && (finger.tip[row] - finger.tip[row - 1]).norm() > kJumpMm;
}

void touch(engine::ServoPlan& plan, const std::vector<trace::RecordedFinger>& fingers, RecordedTouch& recorded) {
  std::size_t row = 0;
  servo::Rig rig = rigFor(plan, fingers, recorded.ticks_per_s, row);
  std::vector<trace::Sample> samples(fingers.size());
  const trace::RecordedFinger& clock = fingers.front();
  for (; row < clock.tip.size(); ++row) {
    for (std::size_t f = 0; f < fingers.size(); ++f) {
      if (jumps(fingers[f], row)) engine::forgetTouch(rig.fingers[f]);
    }
    servo::runTick(rig, row, servo::LoopEvent::none, samples);
    const double since_s = clock.time_s[row] - clock.time_s.front();
    for (trace::Sample& sample : samples) {
      sample.tick = static_cast<std::uint64_t>(std::llround(since_s * recorded.ticks_per_s));
      recorded.history.add(sample);
    }
  }
}

}  // namespace

RecordedTouch touchedAgain(const std::shared_ptr<const scene::World>& world, const scene::Scene& scene,
                           const std::filesystem::path& table) {
  std::vector<trace::RecordedFinger> fingers = trace::readForcesTable(table);
  if (fingers.size() > kFingers) fingers.resize(kFingers);
  RecordedTouch recorded;
  recorded.file = table.string();
  recorded.ticks_per_s = ticksPerS(fingers.front(), scene.ticks_per_s);
  const double seconds = static_cast<double>(fingers.front().tip.size()) / recorded.ticks_per_s;
  recorded.history = TouchHistory(recorded.ticks_per_s, std::min(seconds, kLongestReplayS));
  engine::ServoPlan plan = planFor(world, scene, true);
  touch(plan, fingers, recorded);
  return recorded;
}

bool ReplayLoader::load(std::shared_ptr<const scene::World> world, scene::Scene scene, const std::string& file) {
  if (work_) return false;
  result_ = {};
  work_.emplace([this, world = std::move(world), scene = std::move(scene), file] {
    try {
      result_.touch = touchedAgain(world, scene, file);
    } catch (const std::exception& error) {
      result_.error = error.what();
    }
  });
  return true;
}

std::optional<ReplayLoader::Result> ReplayLoader::take() {
  if (!work_ || !work_->done()) return std::nullopt;
  work_->join();
  work_.reset();
  return std::move(result_);
}

}  // namespace palpate::viewer
