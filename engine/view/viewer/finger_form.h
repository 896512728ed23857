// Chooses fingers, or hands where there is time for them, unless the user has chosen (FingerShape::automatic). Pure.
//
//   time between frames, cost of a frame ─► FingerForm ─► finger or hand
//
// A hand costs more than a finger, and only drawing it shows whether it is too much: it is tried when there is time to
// spare, withdrawn when pictures are too slow, and tried again later and later.
#pragma once

#include "palpate/view/look.h"

namespace palpate::viewer {

struct BodyView;

struct FingerFormSettings {
  double slow_s = 1.0 / 30.0;  ///< between two pictures; only faster ones get the hand
  double slow_for_s = 1.0;     ///< time before a hand is withdrawn: a hitch does not count
  /// Share of `slow_s`: with a finger, a picture must cost less. In software a hand doubles the cost.
  double spare_share = 0.5;
  double spare_for_s = 3.0;     ///< time before the first hand
  double again_after_s = 30.0;  ///< with time to spare, before the next one; doubled after each that was too slow
  double hitch_s = 0.5;         ///< between two pictures: the program was stopped, not slow
};

class FingerForm {
 public:
  using Settings = FingerFormSettings;
  explicit FingerForm(const Settings& settings = {}) : settings_(settings), wait_s_(settings.spare_for_s) {}

  /// Once a frame: the time since the frame before and the cost of this one. `counts` is false for irrelevant frames:
  /// no finger is drawn, or another thread loads a body.
  void frame(double between_s, double cost_s, bool counts);
  bool hand() const { return hand_; }
  /// The user chose: starts over.
  void reset() { *this = FingerForm(settings_); }

 private:
  void frameOfHand(double between_s);
  void frameOfFinger(double between_s, double cost_s);

  Settings settings_;
  bool hand_ = false;
  double wait_s_;  ///< spare time before the next hand
  double again_s_ = 0.0;
  double slow_s_ = 0.0;
  double spare_s_ = 0.0;
};

/// Once a frame: the shape of the viewer's fingers. Never `automatic`.
view::FingerShape fingerShapeNow(FingerForm& form, const BodyView& seen, double elapsed_s, bool counts);

}  // namespace palpate::viewer
