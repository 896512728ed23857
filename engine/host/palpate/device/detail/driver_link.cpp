// Silence is counted, not clocked: in the driver's ticks on its side, in the servo's on the other, so that a test can
// step both by hand. A loop that is late by one tick is forgiven, the second zeroes.
#include "palpate/device/detail/driver_link.h"

#include <algorithm>
#include <cmath>

namespace palpate::device {

namespace {

/// Driver's ticks without a new force after which it is forgotten: two of the servo's.
std::uint64_t silentLimit(const DriverLinkSettings& settings) {
  const double ticks = std::ceil(2.0 * settings.tick_s * settings.driver_rate_hz - 1e-9);
  return static_cast<std::uint64_t>(std::clamp(ticks, 1.0, 1e6));
}

}  // namespace

DriverLink::DriverLink(const DriverLinkSettings& settings) : settings_(settings), silent_limit_(silentLimit(settings)) {
  state_.faults = kNoPose;
}

Vec3 DriverLink::dueForce() noexcept {
  const Force& force = forces_.newest();
  silent_ticks_ = force.number == force_at_work_ ? silent_ticks_ + 1 : 0;
  force_at_work_ = force.number;
  if (silent_ticks_ >= silent_limit_ || !force.safe || muted() || driverFaults() != 0) return Vec3::Zero();
  return force.newtons;
}

void DriverLink::publish(const DriverReading& reading) noexcept {
  Reading next;
  static_cast<DriverReading&>(next) = reading;
  if (!reading.tip.allFinite()) next.faults |= kNoPose;
  if (!reading.velocity.allFinite()) next.velocity = Vec3::Zero();
  next.number = ++readings_made_;
  next.force = force_at_work_;
  driver_faults_.store(next.faults, std::memory_order_relaxed);
  readings_.publish(next);
}

Vec3 DriverLink::read(std::uint64_t tick) noexcept {
  const Reading& reading = readings_.newest();
  if (reading.number != last_reading_) {
    last_reading_ = reading.number;
    last_fresh_tick_ = tick;
  }
  state_.velocity = reading.velocity;
  state_.buttons = reading.buttons;
  state_.notes = reading.notes;
  state_.faults = reading.faults;
  state_.age_ticks = tick > last_fresh_tick_ ? tick - last_fresh_tick_ : 0;  // a servo may count from 0 again
  if (reading.number == 0) state_.faults |= kNoPose;
  if (state_.age_ticks > kMaxPoseTicks) state_.faults |= kStalePose;
  if (muted()) state_.faults |= kClosed;
  if (probe_force_ != 0 && reading.force >= probe_force_) {
    state_.loop_ticks = tick - probe_tick_;
    probe_force_ = 0;
  }
  if (probe_force_ == 0) {
    probe_force_ = forces_sent_ + 1;
    probe_tick_ = tick;
  }
  return state_.faults == 0 ? reading.tip : kNoPlace;
}

void DriverLink::write(const Vec3& force) noexcept {
  Force next;
  next.number = ++forces_sent_;
  next.safe = state_.faults == 0 && force.allFinite();
  if (next.safe) {
    const double length = force.norm();
    const bool too_long = settings_.max_force_n > 0.0 && length > settings_.max_force_n;
    next.newtons = too_long ? Vec3((settings_.max_force_n / length) * force) : force;
  }
  forces_.publish(next);
}

}  // namespace palpate::device
