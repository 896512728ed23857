// A sitting that is under way, with what must not be lost of it: its rows in the record before the next screen, its
// ticks in a session file that trials point into.
//
//   Sitting::takeRows ─ keep ─► Store           servo ─► engine::SessionRecorder ─► sessions/ID.session ─ locked when
//   it is over
//
// Where a row cannot be written it waits, and nothing goes on until it is.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "palpate/engine/session_recorder.h"
#include "palpate/training/records/session_files.h"
#include "palpate/training/sitting.h"
#include "view/viewer/world/live_servo.h"

namespace palpate::viewer {

class SittingRun {
 public:
  /// Begins the session file, where the plan names one. All must outlive it. Throws Error.
  SittingRun(training::Store& store, LiveServo& servo, const training::SittingPlan& plan, const training::Moment& now);
  /// As `finish`, without a word.
  ~SittingRun();
  SittingRun(const SittingRun&) = delete;
  SittingRun& operator=(const SittingRun&) = delete;

  training::Sitting& sitting() { return *sitting_; }
  const training::Sitting& sitting() const { return *sitting_; }

  /// Rows go into the record; whether nothing waits. If not, `trouble` says why.
  bool keep();
  const std::string& trouble() const { return trouble_; }
  /// The session file is finished and locked with the trainee's key. Leaves what is under way. Words for the user about
  /// what went wrong; empty: all is well.
  std::string finish(std::string_view ended_by, const training::Moment& now);

 private:
  void record(LiveServo& servo);
  void mark(const training::Row& row);
  void finishFile(std::string_view ended_by);

  training::Store& store_;
  training::SessionFiles files_;
  std::filesystem::path file_;
  std::unique_ptr<training::Sitting> sitting_;
  std::unique_ptr<engine::SessionRecorder> recorder_;
  std::vector<training::Row> waiting_;
  std::string trouble_;
  training::Moment latest_;
  bool finished_ = false;
};

}  // namespace palpate::viewer
