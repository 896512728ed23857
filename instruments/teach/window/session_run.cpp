#include "teach/window/session_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "palpate/base/error.h"

namespace palpate::viewer {

namespace {

/// "Answer saved." stays this long over the next trial, s.
constexpr double kAnswerSavedS = 3.0;

bool hidesTheSame(const scene::Scene& a, const scene::Scene& b) {
  const auto same_lump = [](const scene::LumpSettings& x, const scene::LumpSettings& y) {
    return x.x_mm == y.x_mm && x.y_mm == y.y_mm && x.diameter_mm == y.diameter_mm && x.depth_mm == y.depth_mm &&
           x.stiffness_ratio == y.stiffness_ratio && x.mobility_mm_per_n == y.mobility_mm_per_n;
  };
  return a.dysfunctions == b.dysfunctions && std::ranges::equal(a.lumps, b.lumps, same_lump);
}

std::vector<trace::RecordingFinger> fingersOf(LiveServo& servo) {
  std::vector<trace::RecordingFinger> fingers;
  for (std::size_t i = 0; i < kFingers; ++i) {
    std::string name(kFingerNames[i]);
    if (servo.isHeld(i)) {
      fingers.push_back(engine::recordingFinger(std::move(name), servo.device(i), &servo.opened(i).workspace.frame));
    } else {
      fingers.push_back({std::move(name), "mouse"});
    }
  }
  return fingers;
}

}  // namespace

RowWriter::RowWriter(training::Store& store, LiveServo& servo, const std::string& file) : store_(store), files_(store) {
  if (!file.empty()) file_ = files_.pathOf(file);
  record(servo);
}

void RowWriter::record(LiveServo& servo) {
  if (file_.empty()) return;
  engine::RecorderSettings settings;
  settings.header = engine::recordingHeader(servo.thread().ticksPerS());
  settings.header.tags = "training";
  settings.fingers = fingersOf(servo);
  settings.file = file_;
  files_.makeFolder();
  recorder_ = std::make_unique<engine::Recorder>(servo.thread(), std::move(settings));
}

/// Marks the trials in the recording for its readers.
void RowWriter::mark(const training::Row& row) {
  if (!recorder_) return;
  if (const auto* trial = std::get_if<training::TrialRow>(&row)) {
    recorder_->mark(
        fmt::format("trial {}: ticks {} to {}", trial->number, trial->file_tick_first, trial->file_tick_last));
  } else if (const auto* event = std::get_if<training::EventRow>(&row)) {
    recorder_->event("note", fmt::format("{}: {}", event->kind, event->text));
  }
}

bool RowWriter::save(std::vector<training::Row> rows) {
  for (training::Row& row : rows) {
    mark(row);
    waiting_.push_back(std::move(row));
  }
  if (waiting_.empty()) return true;
  try {
    store_.save(waiting_);
  } catch (const std::exception& error) {
    trouble_ = error.what();
    return false;
  }
  waiting_.clear();
  trouble_.clear();
  return true;
}

std::string RowWriter::finish(const training::Uuid& session, std::string_view ended_by) {
  if (!recorder_) return {};
  try {
    const auto recorder = std::exchange(recorder_, nullptr);
    recorder->finish(ended_by);
    files_.lock(session);
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

void SessionRun::advance(double elapsed_s, bool stands_still) {
  if (!stands_still && !world_.waiting()) {
    clock_s_ += elapsed_s;
    session().tick(now());
  }
  const std::uint64_t number = session().said().number;
  if (std::exchange(said_, number) != number) said_s_ = clock_s_;
}

bool SessionRun::saidLongAgo() const { return clock_s_ - said_s_ > kAnswerSavedS; }

void SessionRun::feel(const trace::Sample& sample, bool came, bool stands_still) {
  tick_ = std::max(tick_, sample.tick);
  if (stands_still || world_.waiting()) return;
  const bool on_trial = session().screen() == training::Screen::trial && !session().paused();
  if (came && on_trial && world_.begins()) session().ready(now());
  task_->feel(sample, now());
}

void SessionRun::requestBody(ViewerState& viewer, WorldSwap& world_swap, bool stands_still) {
  const TrialWorld::Body body = stands_still ? TrialWorld::Body{} : task_->wanted();
  if (world_.request(body)) world_swap.showTemporarily(task_->makeScene(base_, body), viewer);
}

void SessionRun::handleNewWorld(const scene::World& world) {
  if (!world_.waiting()) return;
  world_.taken(hidesTheSame(world.scene, task_->makeScene(base_, world_.requested().value_or(TrialWorld::Body{}))));
  task_->handleNewWorld(world);
}

Task::Acted SessionRun::act(const TrainingClick& click) {
  if (click.act == TrainingAct::pause) return session().pause(now()), Task::Acted::done;
  if (click.act == TrainingAct::go_on) return session().goOn(now()), Task::Acted::done;
  return task_->act(click, world_.waiting(), now());
}

std::string SessionRun::finish(std::string_view ended_by) {
  session().leave(now());
  const bool kept = save();
  const std::string words = rows_.finish(session().plan().row.id, ended_by);
  return kept ? words : trouble();
}

}  // namespace palpate::viewer
