// A session that is under way, with what must not be lost of it: its rows in the record before the next screen, its
// ticks in a recording that trials point into.
//
//   Session::drainRows ─ save ─► Store           servo ─► engine::Recorder ─► sessions/ID.session ─ locked when
//   it is over
//
// A row that cannot be written waits, and the session does not continue until it is written.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "palpate/engine/recorder.h"
#include "palpate/training/records/recording_files.h"
#include "palpate/training/session/session.h"
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
  /// Starts the recording if the plan names a file. All must outlive it. Throws Error.
  SessionRun(training::Store& store, LiveServo& servo, const training::SessionPlan& plan, const training::Moment& now);
  /// As `finish`, without a word.
  ~SessionRun();
  SessionRun(const SessionRun&) = delete;
  SessionRun& operator=(const SessionRun&) = delete;

  training::Session& session() { return *session_; }
  const training::Session& session() const { return *session_; }

  /// Rows go into the record; whether nothing waits. If not, `trouble` says why.
  bool save() { return rows_.save(session_->drainRows()); }
  const std::string& trouble() const { return rows_.trouble(); }
  /// The recording is finished and locked with the trainee's key. Leaves a running session. Words for the user about
  /// what went wrong; empty: all is well.
  std::string finish(std::string_view ended_by, const training::Moment& now);

 private:
  RowWriter rows_;
  std::unique_ptr<training::Session> session_;
  training::Moment latest_;
  bool finished_ = false;
};

// The body of a trial on its way to the finger. Its making takes time, and the clock of a trial begins with the first
// tick that is felt on it.
//
//   requested ─ built on its own thread, handed to the servo ─► taken ─ first tick on it ─► felt
//
// Pure: it builds nothing.

class TrialWorld {
 public:
  /// A body to be felt, and for which trial: another trial is another body, even if the place is the same, so that the
  /// build time reveals nothing.
  struct Body {
    std::optional<training::HiddenNow> hidden = {};
    int trial = 0;
    friend bool operator==(const Body&, const Body&) = default;
  };

  /// True if it is another one than was requested last: it has to be made.
  bool request(const Body& body) {
    if (requested_ == body) return false;
    requested_ = body;
    state_ = State::requested;
    before_ = newest_;
    return true;
  }
  const std::optional<Body>& requested() const { return requested_; }
  /// The servo has taken a world: the requested one, or another.
  void taken(bool as_requested) {
    if (waiting()) state_ = as_requested ? State::taken : State::requested;
  }
  /// Every tick, with the number of the world it was felt on. True once, with the first one on the requested body.
  bool feel(std::uint32_t world) {
    newest_ = std::max(newest_, world);
    if (state_ != State::taken || world <= before_) return false;
    state_ = State::felt;
    return true;
  }
  /// Requested, and not felt yet.
  bool waiting() const { return state_ != State::felt; }
  /// True once for each trial: an interrupted one continues when its body is built again.
  bool begins() {
    if (!requested_ || begun_ == *requested_) return false;
    begun_ = *requested_;
    return true;
  }
  /// It could not be made: the next request makes it again.
  void fail() { requested_.reset(); }
  /// No trial is under way.
  void clear() {
    requested_.reset();
    begun_ = kNone;
    state_ = State::felt;
  }

 private:
  enum class State : std::uint8_t { requested, taken, felt };
  static constexpr Body kNone = {.hidden = std::nullopt, .trial = -1};
  State state_ = State::felt;
  std::optional<Body> requested_;
  Body begun_ = kNone;        ///< clock has begun; GCC 12.2 miscompiles the comparison of two optionals here
  std::uint32_t newest_ = 0;  ///< newest of the worlds that were felt
  std::uint32_t before_ = 0;  ///< the newest when the body was requested
};

}  // namespace palpate::viewer
