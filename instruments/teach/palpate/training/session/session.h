// One session of one trainee, from the code at the door to the summary, as a machine of screens: the window shows them
// and passes on the trainee's actions; a simulated trainee does the same without a window.
//
//   code, device, "next", answers, samples ─► Session ─► screen, words, hidden place now (trial_scene.h), rows to keep
//
// Knows no clock (every event carries its Moment), no window, no file. Returns rows to store (`drainRows`), in order; a
// trial counts as stored when its rows are. One thread.
#pragma once

#include <optional>
#include <string>

#include "palpate/training/exploration.h"
#include "palpate/training/session/sitting.h"

namespace palpate::training {

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

/// The row to store before the first block, which names it.
ProtocolRow makeProtocolRow(const Protocol& protocol);

class Session final : public Sitting {
 public:
  /// Throws Error where a resumed block does not fit.
  Session(const SessionPlan& plan, const Moment& now);

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
  void ready(const Moment& now) override;
  void feel(const trace::Sample& sample, const Moment& now) override;
  void next(const Moment& now) override;
  /// A site's number. The first answer with places not yet pressed is answered by words only; the same answer again is
  /// taken, flagged. In familiarisation: which of the two is stiffer. True: it was taken.
  bool answer(int site, const Moment& now);
  void tick(const Moment& now) override;
  void safety(const std::string& what, const Moment& now);  ///< an event for the record

  std::optional<BlockResult> result() const;  ///< once a block is over

 private:
  struct Impl;
  Impl& impl_;
};

}  // namespace palpate::training
