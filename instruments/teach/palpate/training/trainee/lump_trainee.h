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

#include <vector>

#include "palpate/training/session/lump_session.h"
#include "palpate/training/trainee/body_touch.h"
#include "palpate/training/trainee/trainee_run.h"

namespace palpate::training {

class LumpRun final : public SittingRun {
 public:
  LumpRun(LumpSession& session, BodyTouch& touch, const TraineeOrders& orders, std::int64_t start_ms);

 private:
  /// A lump as it was felt.
  struct FeltLump {
    lumps::HiddenLump truth;
    double clarity = 0.0;
    Vec2 named_mm = Vec2::Zero();  ///< where it seems to be
  };
  void walkScreen() override;
  void tryBody();
  FeltLump feel(const lumps::HiddenLump& lump);
  void press(const Vec2& place_mm, contact::FingerOutput* firmest);
  /// Findings that it would name in this body, without those named before an interruption.
  std::vector<FeltLump> searchForLumps(const std::vector<lumps::HiddenLump>& hidden);
  bool isNamed(const lumps::HiddenLump& lump) const;
  void answerPlace(const FeltLump& lump);
  void describe(const FeltLump& lump);
  int drawAnswer(int truth, int choices, double clarity);

  LumpSession& session_;
  BodyTouch& touch_;
  double skill_ = 0.0;  ///< this person's, in ln C
};

}  // namespace palpate::training
