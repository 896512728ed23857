#include "palpate/training/session/trial_watch.h"

#include <algorithm>

namespace palpate::training {

namespace {

/// Faster than this along the skin is searching, mm/s: a press that stays wanders by less.
constexpr double kSearchSpeed = 20.0;
/// Velocities are smoothed over this long, s: a device that counts in 0.02 mm steps seems to jump at 20 mm/s each tick.
constexpr double kSmoothingS = 0.05;

}  // namespace

void TrialWatch::follow(const trace::Sample& sample) noexcept {
  if (sample.finger >= kMaxFingers) return;
  Moving& finger = fingers_[sample.finger];
  const contact::FingerOutput& contact = sample.contact;
  const bool touches = contact.touch != contact::Touch::free;
  if (touches && finger.touched) {
    Vec3 velocity = (contact.tip - finger.tip) / tick_s_;
    velocity -= velocity.dot(contact.normal) * contact.normal;  // along the skin: pressing is not searching
    finger.velocity += std::min(1.0, tick_s_ / kSmoothingS) * (velocity - finger.velocity);
    const double force_n = sample.device_force.norm();
    const double speed = finger.velocity.norm();
    force_.add(force_n);
    speed_.add(speed);
    (speed > kSearchSpeed ? searching_ : staying_).add(force_n);
    peak_n_ = std::max(peak_n_, force_n);
  } else {
    finger.velocity = Vec3::Zero();
  }
  finger.touched = touches;
  finger.tip = contact.tip;
}

void TrialWatch::writeTo(TrialRow& row) const {
  row.mean_force_n = force_.value();
  row.peak_force_n = peak_n_;
  row.mean_speed_mm_per_s = speed_.value();
  row.search_force_n = searching_.value();
  row.palpate_force_n = staying_.value();
}

}  // namespace palpate::training
