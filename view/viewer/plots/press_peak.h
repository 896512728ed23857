// The most that a press came to, kept readable for a moment after the finger was lifted. Pure.
#pragma once

#include <optional>

#include "palpate/contact/finger.h"
#include "palpate/view/finger_pose.h"

namespace palpate::viewer {

class PressPeak {
 public:
  /// Once a frame.
  void follow(const contact::FingerOutput& contact, double now_s);
  /// Nothing while the finger touches, and when the press is long over.
  std::optional<view::Peak> shown(double now_s) const;

 private:
  view::Peak most_;
  std::optional<double> lifted_s_;
  bool touching_ = false;
};

}  // namespace palpate::viewer
