// A simulated trainee in a session with lumps: strokes 16 mm apart run along the back, and of each only the press that
// passes nearest to a lump is made, with the whole haptic loop; elsewhere there is nothing to feel. The cue of that
// press (lumps/lump_observer.h) decides whether the lump is found, and how much is known of it.
//
//   LumpSession::hidden ─ BodyTouch ─► what was felt ─ computeCue, finds ─► answers, places ─► LumpSession ─► rows
//
// Assumed, since no study has measured it: a named place is some millimetres off the lump, or off the finger of a
// trainee who does not feel the pattern; size, depth, hardness and mobility are each known as often as a lump this
// plain is found, and guessed else.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "palpate/training/session/lump_session.h"
#include "palpate/training/trainee/body_touch.h"
#include "palpate/training/trainee/observer.h"

namespace palpate::training {

struct LumpOrders {
  LumpTraineeSettings trainee;
  int most_bodies = 0;  ///< stops the block after this many; 0: continues to its end
  /// Rows in their order, after every answer.
  std::function<void(std::vector<Row>)> save = {};
  std::function<void(const TrialRow&)> answered = {};  ///< once a body's rows are kept; may be empty
  std::function<bool()> stop = {};                     ///< true puts the block down
};

class LumpRun {
 public:
  /// Both must outlive it. `start_ms`: of the touch's tick 0.
  LumpRun(LumpSession& session, BodyTouch& touch, const LumpOrders& orders, std::int64_t start_ms);

  /// To the end of the block, or until it is put down.
  void run();
  Moment now() const;

 private:
  /// A lump as it was felt.
  struct FeltLump {
    lumps::HiddenLump truth;
    double clarity = 0.0;
    Vec2 named_mm = Vec2::Zero();  ///< where it seems to be
  };
  void tryBody();
  FeltLump feel(const lumps::HiddenLump& lump);
  void press(const Vec2& place_mm, contact::FingerOutput* firmest);
  /// Findings that it would name in this body, without those named before an interruption.
  std::vector<FeltLump> searchForLumps(const std::vector<lumps::HiddenLump>& hidden);
  bool isNamed(const lumps::HiddenLump& lump) const;
  void answerPlace(const FeltLump& lump);
  void describe(const FeltLump& lump);
  int known(int truth, int choices, double clarity);
  bool stops() const;
  void storeNewRows();

  LumpSession& session_;
  BodyTouch& touch_;
  LumpOrders orders_;
  std::int64_t start_ms_;
  Random random_;
  double skill_ = 0.0;  ///< this person's, in ln C
  int bodies_ = 0;
};

}  // namespace palpate::training
