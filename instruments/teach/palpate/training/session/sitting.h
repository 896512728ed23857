// Shared by sessions of every kind: their screen and words, their clock, and the rows that they leave. Places are
// asked about in session.h, lumps in lump_session.h.
//
//   samples, "next", answers, pauses ─► Sitting ─► screen, words, rows to keep
//
// Knows no clock (every event carries its Moment), no window, no file. Returns rows to store (`drainRows`), in order; a
// trial counts as stored when its rows are. One thread.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "palpate/base/random.h"
#include "palpate/training/protocol.h"
#include "palpate/training/records/rows.h"
#include "palpate/training/session/trial_watch.h"
#include "palpate/training/wording.h"

namespace palpate::training {

class LumpBodies;

/// Time of an event, on the caller's clocks.
struct Moment {
  double s = 0.0;           ///< steady
  std::int64_t utc_ms = 0;  ///< since 1970
  std::uint64_t tick = 0;   ///< recording's tick
};

enum class Screen : std::uint8_t {
  device_check,     ///< touch the skin once: the device works
  familiarisation,  ///< one obvious change: shown next to a normal place, then requested until it is found
  instruction,
  trial,
  feedback,  ///< practice: right or wrong; the true site can be felt
  block_summary,
  free_exploration,  ///< no questions
  finished,
};

struct SessionPlan {
  Protocol protocol;
  SessionKind kind = SessionKind::practice;
  SiteSet sites;
  std::uint64_t seed = 1;
  double tick_s = 0.001;
  SessionRow row = {};                            ///< ids, station, device and file filled in
  std::optional<BlockRow> resumed = {};           ///< an interrupted block, which continues where it stopped
  std::optional<ShownThreshold> before = {};      ///< the trainee's last measured result, for the summary
  bool familiar = false;                          ///< has had device check and familiarisation today
  std::shared_ptr<const LumpBodies> bodies = {};  ///< for kinds that hide lumps
};

/// Text of a screen, also spoken.
struct Said {
  std::string text;
  std::uint64_t number = 0;  ///< another number: speak it once
};

/// Another seed for every word.
std::uint64_t mixedSeed(std::uint64_t seed, std::string_view word);

/// For session.cpp and lump_session.cpp: what every session remembers.
struct SittingState {
  SittingState(const SessionPlan& the_plan, const Moment& now);
  virtual ~SittingState() = default;
  /// Stands over the trial that is on the screen; empty without one.
  virtual std::string sentence() const = 0;

  void say(std::string text);
  Uuid newId(const Moment& now);
  void recordEvent(std::string kind, std::string text, const Moment& now);
  /// `end_ms`: 0 at the beginning.
  void recordSession(std::int64_t end_ms);
  BlockRow newBlockRow(int number, Method method, ChangeMeaning meaning, const Moment& now);
  TrialRow newTrialRow(int number, const Moment& now);
  void startClock(const Moment& now);
  double elapsed(const Moment& now) const;  ///< since then, s, without pauses
  void finish(const Moment& now);

  SessionPlan plan;
  Random ids;  ///< of rows
  Screen screen = Screen::instruction;
  Said said;
  TrialWatch watch;
  BlockRow block_row;
  std::vector<TrialRow> trials;
  std::vector<Row> rows;
  Moment begun;           ///< the trial
  double paused_s = 0.0;  ///< in this trial
  std::optional<Moment> paused_since;
};

class Sitting {
 public:
  virtual ~Sitting() = default;
  Sitting(const Sitting&) = delete;
  Sitting& operator=(const Sitting&) = delete;

  Screen screen() const { return state_->screen; }
  Said said() const { return state_->said; }
  bool paused() const { return state_->paused_since.has_value(); }
  /// It may be left without a question.
  bool hasEnded() const { return screen() == Screen::block_summary || screen() == Screen::finished; }
  const SessionPlan& plan() const { return state_->plan; }
  const std::vector<TrialRow>& trials() const { return state_->trials; }  ///< of the block, in this session
  std::vector<Row> drainRows() { return std::exchange(state_->rows, {}); }

  // Events.
  /// The world at work holds what the session hides from now on: the trial's clock starts, and samples from before are
  /// forgotten. Callers that rebuild worlds in no time need not call it.
  virtual void ready(const Moment& now) = 0;
  virtual void feel(const trace::Sample& sample, const Moment& now) = 0;  ///< every sample of every finger
  virtual void next(const Moment& now) = 0;                               ///< "Next", "Start", "Continue"
  virtual void tick(const Moment& /*now*/) {}                             ///< any number of times a second: time limits
  virtual void pause(const Moment& now);                                  ///< stops the trial's clock; nothing is felt
  void goOn(const Moment& now);
  /// Leaves now; the block can be taken up again.
  void leave(const Moment& now);

 protected:
  explicit Sitting(std::unique_ptr<SittingState> state) : state_(std::move(state)) {}
  /// In records.
  virtual std::string screenWord() const;

  std::unique_ptr<SittingState> state_;
};

}  // namespace palpate::training

template <>
struct palpate::WordsOf<palpate::training::Screen> {
  using V = palpate::training::Screen;
  static constexpr std::array kAll = {Word{"device_check", V::device_check},
                                      Word{"familiarisation", V::familiarisation},
                                      Word{"instruction", V::instruction},
                                      Word{"trial", V::trial},
                                      Word{"feedback", V::feedback},
                                      Word{"block_summary", V::block_summary},
                                      Word{"free_exploration", V::free_exploration},
                                      Word{"finished", V::finished}};
};
