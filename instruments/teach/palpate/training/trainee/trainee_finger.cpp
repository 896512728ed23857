#include "palpate/training/trainee/trainee_finger.h"

#include <algorithm>
#include <cmath>

namespace palpate::training {

namespace {

/// The pad waits so far over the skin at rest, mm, and rises this share of a way more in the middle of it: skin between
/// two places may be higher than both.
constexpr double kHoverMm = 10.0;
constexpr double kArcShare = 0.12;

/// Time of a way, and of its length: 50 mm in 0.3 s, as people search.
constexpr double kTravelS = 0.2;
constexpr double kTravelMmPerS = 500.0;

/// Speed of the goal on its way into the skin, mm/s; the pad, held back by the tissue, is slower. A press of less than
/// a newton comes down more gently, or the hand's own lag would press harder than that.
constexpr double kDownMmPerS = 60.0;
constexpr double kGentleN = 1.0;
constexpr double kMinShareOfSpeed = 0.2;
/// The goal goes no deeper: nothing is there, or the force is out of the arm's reach.
constexpr double kDeepestGoalMm = 60.0;

constexpr double kUpS = 0.2;

/// The first of a hold is the hand's own settling.
constexpr double kSettleS = 0.1;

/// Physiological tremor of a finger, as in docs/explanation/safety.md.
constexpr double kTremorMm = 0.1;
constexpr double kTremorHz = 9.0;

/// Minimum jerk: 0 to 1 for t in [0, 1].
double smoothShare(double t) {
  const double s = std::clamp(t, 0.0, 1.0);
  return s * s * s * (10.0 + s * (6.0 * s - 15.0));
}

}  // namespace

void TraineeFinger::begin(const PressRequest& request) {
  request_ = request;
  lift_to_ = request.skin + (request.pad_mm + kHoverMm) * request.normal;
  felt_ = {};
  force_sum_ = depth_sum_ = 0.0;
  held_ticks_ = 0;
  enter(Phase::travel);
}

void TraineeFinger::enter(Phase phase) noexcept {
  phase_ = phase;
  time_s_ = 0.0;
  from_ = place_;
}

device::HandGoal TraineeFinger::next(const trace::Sample& sample) noexcept {
  const Vec3 before = place_;
  time_s_ += tick_s_;
  const double force_n = std::max(0.0, sample.device_force.dot(request_.normal));
  switch (phase_) {
    case Phase::travel:
      travel();
      break;
    case Phase::down:
      goDown(force_n);
      break;
    case Phase::hold:
      hold(force_n, sample.contact.depth_mm);
      break;
    case Phase::up:
      goUp();
      break;
    case Phase::over:
      break;
  }
  return {.place = before, .velocity = (place_ - before) / tick_s_};
}

void TraineeFinger::travel() noexcept {
  const Vec3 way = lift_to_ - from_;
  const double seconds = kTravelS + way.norm() / kTravelMmPerS;
  const double share = smoothShare(time_s_ / seconds);
  const double arc = 4.0 * share * (1.0 - share) * kArcShare * way.norm();
  place_ = from_ + share * way + arc * request_.normal;
  if (time_s_ >= seconds) enter(Phase::down);
}

void TraineeFinger::goDown(double force_n) noexcept {
  const double down = kDownMmPerS * std::clamp(request_.force_n / kGentleN, kMinShareOfSpeed, 1.0) * time_s_;
  place_ = from_ - down * request_.normal;
  felt_.reached = force_n >= request_.force_n;
  if (felt_.reached || down >= kHoverMm + kDeepestGoalMm) enter(Phase::hold);
}

void TraineeFinger::hold(double force_n, double depth_mm) noexcept {
  place_ = from_ + kTremorMm * std::sin(2.0 * M_PI * kTremorHz * time_s_) * request_.normal;
  if (time_s_ > std::min(kSettleS, 0.5 * request_.hold_s)) {
    force_sum_ += force_n;
    depth_sum_ += depth_mm;
    ++held_ticks_;
  }
  if (time_s_ < request_.hold_s) return;
  felt_.force_n = force_sum_ / std::max(1, held_ticks_);
  felt_.depth_mm = depth_sum_ / std::max(1, held_ticks_);
  enter(Phase::up);
}

void TraineeFinger::goUp() noexcept {
  place_ = from_ + smoothShare(time_s_ / kUpS) * (lift_to_ - from_);
  if (time_s_ >= kUpS) enter(Phase::over);
}

}  // namespace palpate::training
