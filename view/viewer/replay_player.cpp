#include "view/viewer/replay_player.h"

#include <fmt/format.h>

#include <utility>

#include "palpate/trace/forces_table.h"
#include "palpate/trace/session_reader.h"
#include "view/viewer/files/recorded_session.h"

namespace palpate::viewer {

namespace {

constexpr const char* kStillReading = "Another table is still being read";

}  // namespace

void ReplayPlayer::load(const std::string& file, bool beside, const std::shared_ptr<const scene::World>& world,
                        Session& session) {
  const auto read = [world, scene = session.scene, file] {
    return trace::isSession(file) ? touchOfSession(file) : touchedAgain(world, scene, file);
  };
  if (!loader_.load(read)) return session.report(Severity::info, kStillReading);
  loads_beside_ = beside;
}

void ReplayPlayer::playScript(const std::shared_ptr<const scene::World>& world, Session& session) {
  if (recorded_ && recorded_->of_script) return freeze(session.replay, false);
  if (world->scene.fingers.empty()) {
    return session.report(Severity::info, "This scene has no fingers of its own: it says nothing under [[finger]]");
  }
  if (!loader_.load([world] { return touchOfScript(world); })) session.report(Severity::info, kStillReading);
}

void ReplayPlayer::take(const std::shared_ptr<const scene::World>& world, LiveModel& model, Session& session) {
  auto result = loader_.take();
  if (!result) return;
  if (!result->touch) return session.report(Severity::error, "cannot replay " + result->error);
  session.messages.clearErrors("cannot replay ");
  for (const std::string& note : result->touch->notes) session.report(Severity::warning, note);
  if (std::exchange(loads_beside_, false) && recorded_) {
    const auto world_beside = result->touch->world ? result->touch->world : world;
    beside_ = std::make_unique<Beside>(std::move(*result->touch), world_beside);
    session.replay.beside = beside_->touch.file;
    return;
  }
  if (recorded_) leave(world, model, session);
  show(std::move(*result->touch), model, session);
}

void ReplayPlayer::show(RecordedTouch touch, LiveModel& model, Session& session) {
  recorded_ = std::move(touch);
  if (recorded_->world) model.setWorld(recorded_->world);
  const TouchHistory& history = recorded_->history;
  for (SampleHistory& plot : session.plots.fingers) plot = SampleHistory(recorded_->ticks_per_s, kLongestReplayS);
  history.forEach([&](const trace::Sample& sample) { session.plot(sample); });
  session.replay = {.at_s = history.oldestTime(),
                    .from_s = history.oldestTime(),
                    .to_s = history.newestTime(),
                    .playing = recorded_->of_script,
                    .table = recorded_->file,
                    .tick_s = history.tick(),
                    .frozen = true,
                    .marks = recorded_->marks};
  session.plots.paused = false;
  if (!session.beside_at_first.empty()) {
    session.request(OpenBeside{std::exchange(session.beside_at_first, {})});
  }
  if (!trace::isSession(recorded_->file) && trace::isUnfinished(recorded_->file)) {
    session.report(Severity::warning,
                   fmt::format("{} was not finished: its {:.1f} s are what was written before the end", recorded_->file,
                               session.replay.to_s - session.replay.from_s));
  }
}

void ReplayPlayer::leave(const std::shared_ptr<const scene::World>& world, LiveModel& model, Session& session) {
  if (recorded_->world) model.setWorld(world);
  recorded_.reset();
  session.replay = {};
  for (SampleHistory& plot : session.plots.fingers) plot = SampleHistory(session.ticks_per_s);
}

const TouchHistory::Moment* ReplayPlayer::advance(const std::shared_ptr<const scene::World>& world, LiveModel& model,
                                                  Session& session, double elapsed_s) {
  if (!session.replay.frozen && recorded_) leave(world, model, session);
  if (session.replay.beside.empty()) beside_.reset();
  advanceReplay(session.replay, history(), elapsed_s * session.time_speed);
  if (beside_) beside_->model.follow(momentBeside(session.replay));
  return session.replay.frozen && !history().empty() ? &history().at(session.replay.at_s) : nullptr;
}

const TouchHistory::Moment& ReplayPlayer::momentBeside(const Replay& replay) const {
  const TouchHistory& history = beside_->touch.history;
  const double since_s = replay.at_s - replay.from_s;
  return history.at(history.oldestTime() + since_s);
}

}  // namespace palpate::viewer
