// A session that is under way, with what must not be lost of it: its rows in the record before the next screen, its
// ticks in a recording that trials point into; and its clock, which stands while the body is built.
//
//   Sitting::drainRows ─ save ─► Store           servo ─► engine::Recorder ─► sessions/ID.session ─ locked when it is
//   over Task::wanted ─ request ─► WorldSwap (built aside, handed to the servo) ─► the trial's clock begins
//
// A row that cannot be written waits, and the session does not continue until it is written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "palpate/engine/recorder.h"
#include "palpate/training/records/recording_files.h"
#include "palpate/training/records/trainee_code.h"
#include "teach/window/task.h"
#include "view/viewer/world/live_servo.h"

namespace palpate::viewer {

class RowWriter {
 public:
  /// `file`: name of the recording in the session's row; empty: none. Starts it, so that a failure is known before the
  /// first answer. Throws Error.
  RowWriter(training::Store& store, LiveServo& servo, const std::string& file);

  /// Writes them into the record, after waiting ones; true: nothing waits. If not, `trouble` says why.
  bool save(std::vector<training::Row> rows);
  const std::string& trouble() const { return trouble_; }
  /// The recording is finished and locked. Words for the user about what went wrong; empty: all is well.
  std::string finish(const training::Uuid& session, std::string_view ended_by);

 private:
  void record(LiveServo& servo);
  void mark(const training::Row& row);

  training::Store& store_;
  training::RecordingFiles files_;
  std::filesystem::path file_;
  std::unique_ptr<engine::Recorder> recorder_;
  std::vector<training::Row> waiting_;
  std::string trouble_;
};

class SessionRun {
 public:
  /// Starts the recording if the session's row names a file. Store and world must outlive it. Throws Error.
  SessionRun(training::Store& store, LiveServo& servo, TrialWorld& world, scene::Scene base, std::unique_ptr<Task> task)
      : rows_(store, servo, task->session().plan().row.file),
        world_(world),
        base_(std::move(base)),
        task_(std::move(task)) {}

  Task& task() const { return *task_; }
  training::Sitting& session() const { return task_->session(); }
  training::Moment now() const { return {clock_s_, training::utcMs(), tick_}; }
  /// `stands_still`: a question is open. Nothing can be felt then: no searching while the clock is stopped.
  void advance(double elapsed_s, bool stands_still);
  /// `came`: the first tick on the requested body.
  void feel(const trace::Sample& sample, bool came, bool stands_still);
  void requestBody(ViewerState& viewer, WorldSwap& world_swap, bool stands_still);
  void handleNewWorld(const scene::World& world);
  Task::Acted act(const TrainingClick& click);
  /// Whether the last text has been read, and makes room.
  bool saidLongAgo() const;

  /// Rows go into the record; whether nothing waits. If not, `trouble` says why.
  bool save() { return rows_.save(session().drainRows()); }
  const std::string& trouble() const { return rows_.trouble(); }
  /// The recording is finished and locked with the trainee's key. Leaves a running session. Words for the user about
  /// what went wrong; empty: all is well.
  std::string finish(std::string_view ended_by);

 private:
  RowWriter rows_;
  TrialWorld& world_;
  scene::Scene base_;
  std::unique_ptr<Task> task_;
  double clock_s_ = 0.0;
  std::uint64_t tick_ = 0;
  double said_s_ = 0.0;
  std::uint64_t said_ = 0;
};

}  // namespace palpate::viewer
