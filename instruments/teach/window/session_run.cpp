#include "teach/window/session_run.h"

#include <fmt/format.h>

#include <utility>

#include "palpate/base/error.h"

namespace palpate::viewer {

namespace {

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

SessionRun::SessionRun(training::Store& store, LiveServo& servo, const training::SessionPlan& plan,
                       const training::Moment& now)
    : rows_(store, servo, plan.row.file), session_(std::make_unique<training::Session>(plan, now)), latest_(now) {}

SessionRun::~SessionRun() { finish("interrupted", latest_); }

std::string SessionRun::finish(std::string_view ended_by, const training::Moment& now) {
  if (std::exchange(finished_, true) || !session_) return {};
  session_->leave(now);
  const bool kept = save();
  const std::string words = rows_.finish(session_->plan().row.id, ended_by);
  return kept ? words : trouble();
}

}  // namespace palpate::viewer
