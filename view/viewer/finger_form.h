// Draws fingers, and hands where there is time for them, as long as the user has not chosen (FingerShape::automatic).
// Pure.
//
//   time between frames, time that a frame took ─► FingerForm ─► finger or hand
//
// A hand costs more than a finger and whether it is too much is only known by drawing it: it is tried when there is
// time to spare, taken back when pictures come too slowly, and tried again later and later.
#pragma once

#include "palpate/view/look.h"

namespace palpate::viewer {

struct ViewerState;

struct FingerFormSettings {
  double slow_s = 1.0 / 30.0;  ///< between two pictures; the hand is for those who have faster ones
  double slow_for_s = 1.0;     ///< so long before a hand is taken back: a hitch is no reason
  /// Of `slow_s`: with a finger drawn, a picture must cost less. In software a hand doubles the cost.
  double spare_share = 0.5;
  double spare_for_s = 3.0;     ///< so long before the first hand
  double again_after_s = 30.0;  ///< with time to spare, before the next one; twice as long after each that was too slow
  double hitch_s = 0.5;         ///< between two pictures: the program was stopped, not slow
};

class FingerForm {
 public:
  using Settings = FingerFormSettings;
  explicit FingerForm(const Settings& settings = {}) : settings_(settings), wait_s_(settings.spare_for_s) {}

  /// Once a frame: the time since the frame before and what this one cost. `counts` is false for frames that say
  /// nothing: no finger is drawn, or another thread loads a body.
  void frame(double between_s, double cost_s, bool counts);
  bool hand() const { return hand_; }
  /// The user chose: no opinion any more.
  void reset() { *this = FingerForm(settings_); }

 private:
  void frameOfHand(double between_s);
  void frameOfFinger(double between_s, double cost_s);

  Settings settings_;
  bool hand_ = false;
  double wait_s_;  ///< of spare time before the next hand
  double again_s_ = 0.0;
  double slow_s_ = 0.0;
  double spare_s_ = 0.0;
};

/// Once a frame: what the viewer's fingers are drawn as. Never `automatic`.
view::FingerShape fingerShapeNow(FingerForm& form, const ViewerState& viewer, double elapsed_s, bool counts);

}  // namespace palpate::viewer
