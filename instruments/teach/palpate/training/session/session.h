// One session of one trainee, from the code at the door to the summary, as a machine of screens: the window shows them
// and passes on the trainee's actions; a simulated trainee does the same without a window.
//
//   code, device, "next", answers, samples ─► Session ─► screen, words, hidden place now (trial_scene.h), rows to keep
//
// Knows no clock (every event carries its Moment), no window, no file. Returns rows to store (`drainRows`), in order; a
// trial counts as stored when its rows are. One thread.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "palpate/training/exploration.h"
#include "palpate/training/protocol.h"
#include "palpate/training/records/rows.h"
#include "palpate/training/wording.h"

namespace palpate::training {

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
  SessionRow row = {};                        ///< ids, station, device and file filled in
  std::optional<BlockRow> resumed = {};       ///< an interrupted block, which continues where it stopped
  std::optional<ShownThreshold> before = {};  ///< the trainee's last measured result, for the summary
  bool familiar = false;                      ///< has had device check and familiarisation today
};

/// A hidden place that is in the body now.
struct HiddenNow {
  int site = 0;
  double change = 0.0;
  friend bool operator==(const HiddenNow&, const HiddenNow&) = default;
};

/// Familiarisation: the two places that are felt in turn, by number.
struct FamiliarPlaces {
  int first = 0;
  int second = 0;
  int stiffer = 0;  ///< which of them, while it is shown; 0: the trainee is asked
  int round = 0;    ///< number of requests so far: each is another body
};

/// Text of a screen, also spoken.
struct Said {
  std::string text;
  std::uint64_t number = 0;  ///< another number: speak it once
};

/// The row to store before the first block, which names it.
ProtocolRow makeProtocolRow(const Protocol& protocol);

class Session {
 public:
  /// Throws Error where a resumed block does not fit.
  Session(const SessionPlan& plan, const Moment& now);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  Screen screen() const;
  Said said() const;
  /// The hidden place that the world must hold; nothing: none. Never to be shown by a test's screen.
  std::optional<HiddenNow> hidden() const;
  bool feelsTruth() const;  ///< the true site is shown: feedback, and familiarisation that does not ask
  std::optional<FamiliarPlaces> familiarPlaces() const;  ///< during familiarisation alone
  bool asks() const;                                     ///< `answer` would be taken

  // For a trial that is on the screen.
  int trialNumber() const;  ///< from 1
  int trialsAtMost() const;
  double secondsLeft(const Moment& now) const;  ///< infinity without a limit
  double shareOfTimeLeft(const Moment& now) const;
  bool visited(int site) const;
  int touchedSite() const;
  bool showsProgress() const;  ///< practice shows right answers; tests show no level and no number

  // Events.
  /// The world at work has the place of `hidden` from now on: the trial's clock starts, and samples from before are
  /// forgotten. Callers that rebuild worlds in no time need not call it.
  void ready(const Moment& now);
  void feel(const trace::Sample& sample, const Moment& now);  ///< every sample of every finger
  void next(const Moment& now);                               ///< "Next", "Start", "Continue"
  /// A site's number. The first answer with places not yet pressed is answered by words only; the same answer again is
  /// taken, flagged. In familiarisation: which of the two is stiffer. True: it was taken.
  bool answer(int site, const Moment& now);
  void pause(const Moment& now);  ///< stops the trial's clock; nothing is felt
  void goOn(const Moment& now);
  bool paused() const;
  void tick(const Moment& now);                             ///< any number of times a second: time limits
  void safety(const std::string& what, const Moment& now);  ///< an event for the record
  /// Leaves now; the block can be taken up again.
  void leave(const Moment& now);

  const SessionPlan& plan() const;
  const std::vector<TrialRow>& trials() const;  ///< trials of the block in this session
  std::optional<BlockResult> result() const;    ///< once a block is over
  std::vector<Row> drainRows();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
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
