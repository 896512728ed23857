// Measured eyes -> shown eyes: a first-order low-pass, its own speed as the prediction, and a glide back by the same
// filter on silence (head_tracker.h).
#include "palpate/window/head_tracker.h"

#include <algorithm>
#include <cmath>

namespace palpate::window {

namespace {

/// A step of a low-pass: how much of the way is gone after this time.
double shareAfter(double elapsed_s, double constant_s) {
  return constant_s > 0.0 ? 1.0 - std::exp(-std::max(0.0, elapsed_s) / constant_s) : 1.0;
}

}  // namespace

HeadTracker::HeadTracker(const HeadTrackerSettings& given)
    : settings(given), smooth_(given.expected_mm), shown_(given.expected_mm) {}

Vec3 HeadTracker::kept(Vec3 eyes) const {
  eyes.z() = std::max(eyes.z(), settings.nearest_mm);
  return eyes;
}

void HeadTracker::follow(const Vec3& place, double elapsed_s) {
  const double share = shareAfter(elapsed_s, settings.smoothing_s);
  const Vec3 before = smooth_;
  smooth_ += share * (place - smooth_);
  if (elapsed_s > 0.0) speed_ += share * ((smooth_ - before) / elapsed_s - speed_);
}

void HeadTracker::measured(const Vec3& eyes_mm, double now_s) {
  if (!eyes_mm.allFinite()) return;
  const Vec3 place = kept(eyes_mm + settings.offset_mm);
  if (stateAt(now_s) != State::tracking) {
    // Found again: continue from the shown place through the low-pass, instead of a jump.
    smooth_ = shown_;
    speed_.setZero();
    heard_s_ = now_s;
    return;
  }
  follow(place, now_s - *heard_s_);
  heard_s_ = now_s;
}

HeadTracker::State HeadTracker::stateAt(double now_s) const {
  if (!heard_s_) return State::waiting;
  const double silent_s = now_s - *heard_s_;
  if (silent_s <= settings.lost_after_s) return State::tracking;
  return silent_s <= settings.lost_after_s + settings.stand_still_s ? State::standing_still : State::gliding;
}

Vec3 HeadTracker::eyesAt(double now_s) {
  const double elapsed_s = asked_s_ ? now_s - *asked_s_ : 0.0;
  asked_s_ = now_s;
  switch (stateAt(now_s)) {
    case State::waiting:
      shown_ = settings.expected_mm;
      break;
    case State::tracking:
      shown_ = smooth_ + settings.prediction_s * speed_;
      break;
    case State::standing_still:
      break;
    case State::gliding:
      shown_ += shareAfter(elapsed_s, settings.glide_s) * (settings.expected_mm - shown_);
      break;
  }
  shown_ = kept(shown_);
  return shown_;
}

}  // namespace palpate::window
