#include "view/viewer/frame_painter.h"

#include <algorithm>

namespace palpate::viewer {

namespace {

/// Long enough to read two numbers, s.
constexpr double kReadableS = 1.0;

}  // namespace

void PressPeak::follow(const contact::FingerOutput& contact, double now_s) {
  const bool touches = contact.touch != contact::Touch::free;
  if (touches && !touching_) most_ = {};
  if (touches) {
    most_.depth_mm = std::max(most_.depth_mm, contact.depth_mm);
    most_.force_n = std::max(most_.force_n, contact.force.norm());
    lifted_s_.reset();
  } else if (touching_) {
    lifted_s_ = now_s;
  }
  touching_ = touches;
}

std::optional<view::Peak> PressPeak::shown(double now_s) const {
  if (!lifted_s_ || now_s < *lifted_s_ || now_s - *lifted_s_ > kReadableS) return std::nullopt;
  return most_;
}

}  // namespace palpate::viewer
