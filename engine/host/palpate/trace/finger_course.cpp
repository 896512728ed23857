#include "palpate/trace/finger_course.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpate::trace {

namespace {

/// Keeps an absurd tick rate from making a window that fills the memory.
constexpr double kMaxWindowTicks = 1000.0;

/// Whether so many ticks are missing between two that a run ends there.
bool isGap(std::uint64_t before, std::uint64_t after, std::uint64_t gap_ticks) {
  return after - before > gap_ticks + 1;
}

}  // namespace

std::uint64_t ticksIn(double seconds, double ticks_per_s) {
  return static_cast<std::uint64_t>(std::clamp(std::round(seconds * ticks_per_s), 1.0, 1e15));
}

FingerMotion::FingerMotion(double ticks_per_s)
    : ticks_per_s_(ticks_per_s),
      window_ticks_(static_cast<std::uint64_t>(
          std::min(static_cast<double>(ticksIn(kSpeedWindowS, ticks_per_s)), kMaxWindowTicks))) {}

FingerSpeeds FingerMotion::add(const Sample& sample) {
  if (sample.forgot != 0) places_.clear();
  while (!places_.empty() && sample.tick - places_.front().tick > window_ticks_) places_.pop_front();
  places_.push_back({sample.tick, sample.contact.proxy, sample.contact.tip});
  const bool touching = sample.contact.touch != contact::Touch::free;
  if (touching != touching_) turned_ = sample.tick;
  touching_ = touching;
  // The first of the window that the proxy may be compared with.
  const Place& then = *std::find_if(places_.begin(), places_.end(), [&](const Place& p) { return p.tick >= turned_; });
  const Place& oldest = places_.front();
  return {speedOver(sample.tick - then.tick, (sample.contact.proxy - then.proxy).norm()),
          speedOver(sample.tick - oldest.tick, (sample.contact.tip - oldest.tip).norm())};
}

double FingerMotion::speedOver(std::uint64_t ticks, double way_mm) const {
  if (ticks < std::max<std::uint64_t>(1, window_ticks_ / 2)) return std::numeric_limits<double>::quiet_NaN();
  return way_mm / (static_cast<double>(ticks) / ticks_per_s_);
}

ContactRuns::ContactRuns(double ticks_per_s) : gap_ticks_(ticksIn(kJoinedGapS, ticks_per_s)) {}

std::optional<Contact> ContactRuns::add(const Sample& sample) {
  std::optional<Contact> ended;
  const bool put_elsewhere = (sample.forgot & kForgotTouch) != 0;
  if (open_ && (put_elsewhere || isGap(open_->last_tick, sample.tick, gap_ticks_))) ended = finish();
  const contact::FingerOutput& felt = sample.contact;
  if (felt.touch == contact::Touch::free) return ended;
  if (!open_) {
    open_ = Contact{.finger = sample.finger, .first_tick = sample.tick, .peak_place = felt.proxy};
    force_sum_n_ = 0.0;
    counted_ = felt.proxy;
  }
  const double force = felt.force.norm();
  open_->last_tick = sample.tick;
  ++open_->touching;
  force_sum_n_ += force;
  open_->peak_depth_mm = std::max(open_->peak_depth_mm, felt.depth_mm);
  if (force > open_->peak_force_n) {
    open_->peak_force_n = force;
    open_->peak_place = felt.proxy;
  }
  last_ = felt.proxy;
  const double moved = (last_ - counted_).norm();
  if (moved >= kPathStepMm) {
    open_->path_mm += moved;
    counted_ = last_;
  }
  return ended;
}

std::optional<Contact> ContactRuns::finish() {
  if (!open_) return std::nullopt;
  Contact contact = *open_;
  contact.mean_force_n = force_sum_n_ / static_cast<double>(contact.touching);
  contact.path_mm += (last_ - counted_).norm();  // less than a step
  open_.reset();
  return contact;
}

Phase phaseOf(bool touching, double force_n, double proxy_speed_mm_per_s) {
  if (!touching) return Phase::away;
  const bool presses = force_n >= kLightForceN;
  const bool moves = proxy_speed_mm_per_s > kDwellSpeedMmPerS;  // not where the speed is unknown
  return presses && !moves ? Phase::palpation : Phase::search;
}

PhaseRuns::PhaseRuns(std::uint32_t finger, double ticks_per_s)
    : gap_ticks_(ticksIn(kJoinedGapS, ticks_per_s)), least_ticks_(ticksIn(kMinPhaseS, ticks_per_s)) {
  current_.finger = finger;
}

void PhaseRuns::begin(std::uint64_t tick, Phase now) {
  begun_ = true;
  current_.phase = now;
  current_.first_tick = tick;
  next_ = now;
}

std::optional<PhaseSpan> PhaseRuns::add(std::uint64_t tick, Phase now) {
  std::optional<PhaseSpan> ended;
  if (!begun_) {
    begin(tick, now);
  } else if (isGap(current_.last_tick, tick, gap_ticks_)) {
    ended = finish();
    begin(tick, now);
  } else if (now == current_.phase) {
    next_ = now;
  } else {
    if (now != next_) next_begin_ = tick;
    next_ = now;
    if (tick - next_begin_ + 1 >= least_ticks_) {
      ended = current_;
      ended->last_tick = next_begin_ - 1;
      begin(next_begin_, now);
    }
  }
  current_.last_tick = tick;
  return ended;
}

std::optional<PhaseSpan> PhaseRuns::finish() const {
  return begun_ ? std::optional<PhaseSpan>(current_) : std::nullopt;
}

}  // namespace palpate::trace
