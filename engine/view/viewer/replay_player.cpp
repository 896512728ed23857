#include "view/viewer/replay_player.h"

#include <fmt/format.h>

#include <utility>

#include "palpate/base/language.h"
#include "palpate/base/path_text.h"
#include "palpate/trace/forces_table.h"
#include "palpate/trace/recording_reader.h"
#include "view/viewer/files/recorded_touch.h"

namespace palpate::viewer {

namespace {

constexpr const char* kStillReading = toTranslate("Another table is still being read");

}  // namespace

void ReplayPlayer::load(const std::string& file, bool beside, const std::shared_ptr<const scene::World>& world,
                        const scene::Scene& scene) {
  const auto read = [world, scene, file](const Progress& progress) {
    return trace::isRecording(pathOf(file)) ? touchOfSession(pathOf(file), progress)
                                            : touchedAgain(world, scene, pathOf(file), progress);
  };
  if (!loader_.load(read)) return user_.report(Severity::info, kStillReading);
  loads_beside_ = beside;
}

void ReplayPlayer::playScript(const std::shared_ptr<const scene::World>& world) {
  if (recorded_ && recorded_->of_script) return freeze(past_.replay, false);
  if (world->scene.fingers.empty()) {
    return user_.report(Severity::info, "This scene has no fingers of its own; add a [[finger]] to its file");
  }
  if (!loader_.load([world](const Progress& progress) { return touchOfScript(world, progress); }))
    user_.report(Severity::info, kStillReading);
}

void ReplayPlayer::collectResult(const std::shared_ptr<const scene::World>& world, LiveModel& model,
                                 double device_limit_n) {
  auto result = loader_.collectResult();
  if (!result) return;
  if (!result->touch) return user_.report(Severity::error, trf("cannot replay {}", result->error));
  user_.messages.clearErrors(trf("cannot replay {}", std::string()));
  for (const std::string& note : result->touch->notes) user_.report(Severity::warning, note);
  if (std::exchange(loads_beside_, false) && recorded_) {
    const auto world_beside = result->touch->world ? result->touch->world : world;
    beside_ = std::make_unique<Beside>(std::move(*result->touch), world_beside);
    past_.replay.beside = beside_->touch.file;
    return;
  }
  if (recorded_) leave(world, model);
  show(std::move(*result->touch), model, device_limit_n);
}

void ReplayPlayer::cancel() {
  loader_.cancel();
  user_.report(Severity::info, "Cancelled: nothing is replayed");
}

void ReplayPlayer::show(RecordedTouch touch, LiveModel& model, double device_limit_n) {
  recorded_ = std::move(touch);
  if (recorded_->world) model.setWorld(recorded_->world);
  const TouchHistory& history = recorded_->history;
  for (SampleHistory& plot : past_.plots.fingers) plot = SampleHistory(recorded_->ticks_per_s, kLongestReplayS);
  history.forEach([&](const trace::Sample& sample) { past_.plot(sample, device_limit_n); });
  past_.replay = {.at_s = history.oldestTime(),
                  .from_s = history.oldestTime(),
                  .to_s = history.newestTime(),
                  .playing = recorded_->of_script,
                  .table = recorded_->file,
                  .tick_s = history.tick(),
                  .frozen = true,
                  .marks = recorded_->marks};
  past_.plots.paused = false;
  if (!past_.beside_at_first.empty()) {
    user_.request(OpenBeside{std::exchange(past_.beside_at_first, {})});
  }
  if (!trace::isRecording(pathOf(recorded_->file)) && trace::isUnfinished(pathOf(recorded_->file))) {
    user_.report(Severity::warning, trf("{} was interrupted: the {:.1f} s written until then are shown",
                                        recorded_->file, past_.replay.to_s - past_.replay.from_s));
  }
}

void ReplayPlayer::leave(const std::shared_ptr<const scene::World>& world, LiveModel& model) {
  if (recorded_->world) model.setWorld(world);
  recorded_.reset();
  past_.replay = {};
  for (SampleHistory& plot : past_.plots.fingers) plot = SampleHistory(ticks_per_s_);
}

const TouchHistory::Moment* ReplayPlayer::advance(const std::shared_ptr<const scene::World>& world, LiveModel& model,
                                                  double elapsed_s) {
  if (!past_.replay.frozen && recorded_) leave(world, model);
  if (past_.replay.beside.empty()) beside_.reset();
  advanceReplay(past_.replay, history(), elapsed_s * past_.time_speed);
  if (beside_) beside_->model.follow(momentBeside(past_.replay));
  return past_.replay.frozen && !history().empty() ? &history().at(past_.replay.at_s) : nullptr;
}

const TouchHistory::Moment& ReplayPlayer::momentBeside(const Replay& replay) const {
  const TouchHistory& history = beside_->touch.history;
  const double since_s = replay.at_s - replay.from_s;
  return history.at(history.oldestTime() + since_s);
}

}  // namespace palpate::viewer
