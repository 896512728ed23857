#include "teach/window/sitting_run.h"

#include <fmt/format.h>

#include <utility>

#include "palpate/base/error.h"

namespace palpate::viewer {

namespace {

std::vector<trace::SessionFinger> fingersOf(LiveServo& servo) {
  std::vector<trace::SessionFinger> fingers;
  for (std::size_t i = 0; i < kFingers; ++i) {
    std::string name(kFingerNames[i]);
    if (servo.isHeld(i)) {
      fingers.push_back(engine::sessionFinger(std::move(name), servo.device(i), &servo.opened(i).workspace.frame));
    } else {
      fingers.push_back({std::move(name), "mouse"});
    }
  }
  return fingers;
}

}  // namespace

SittingRun::SittingRun(training::Store& store, LiveServo& servo, const training::SittingPlan& plan,
                       const training::Moment& now)
    : store_(store), files_(store), latest_(now) {
  if (!plan.row.file.empty()) file_ = files_.pathOf(plan.row.file);
  // A file that cannot be made is told before anybody has answered anything.
  record(servo);
  sitting_ = std::make_unique<training::Sitting>(plan, now);
}

SittingRun::~SittingRun() { finish("interrupted", latest_); }

void SittingRun::record(LiveServo& servo) {
  if (file_.empty()) return;
  engine::RecorderSettings settings;
  settings.header = engine::sessionHeader(servo.thread().ticksPerS());
  settings.header.tags = "training";
  settings.fingers = fingersOf(servo);
  settings.file = file_;
  files_.makeFolder();
  recorder_ = std::make_unique<engine::SessionRecorder>(servo.thread(), std::move(settings));
}

/// So that whoever opens the session file finds the trials in it.
void SittingRun::mark(const training::Row& row) {
  if (!recorder_) return;
  if (const auto* trial = std::get_if<training::TrialRow>(&row)) {
    recorder_->mark(fmt::format("trial {}: ticks {} to {}", trial->number, trial->file_tick0, trial->file_tick1));
  } else if (const auto* event = std::get_if<training::EventRow>(&row)) {
    recorder_->event("note", fmt::format("{}: {}", event->kind, event->text));
  }
}

bool SittingRun::keep() {
  for (training::Row& row : sitting_->takeRows()) {
    mark(row);
    waiting_.push_back(std::move(row));
  }
  if (waiting_.empty()) return true;
  try {
    store_.keep(waiting_);
  } catch (const std::exception& error) {
    trouble_ = error.what();
    return false;
  }
  waiting_.clear();
  trouble_.clear();
  return true;
}

std::string SittingRun::finish(std::string_view ended_by, const training::Moment& now) {
  if (std::exchange(finished_, true) || !sitting_) return {};
  sitting_->leave(now);
  std::string words;
  if (!keep()) words = trouble_;
  try {
    finishFile(ended_by);
  } catch (const std::exception& error) {
    if (words.empty()) words = error.what();
  }
  return words;
}

void SittingRun::finishFile(std::string_view ended_by) {
  if (!recorder_) return;
  const auto recorder = std::exchange(recorder_, nullptr);
  recorder->finish(ended_by);
  files_.lock(sitting_->plan().row.id);
}

}  // namespace palpate::viewer
