// Deadline k is start + k periods in whole nanoseconds: nothing adds up. Sleep until shortly before it, and the
// rest by reading the clock.
#include "palpate/servo/pacing.h"

#include <algorithm>
#include <cmath>

#include "palpate/base/stopwatch.h"

namespace palpate::servo {

PacingGrant prepareServoThread(const PacingSettings& settings) {
  if (settings.realtime) return system::askForRealtime(settings.realtime_priority);
  PacingGrant grant;
  grant.note = "real-time scheduling not asked for";
  return grant;
}

void releaseServoMemory(const PacingGrant& grant) {
  if (grant.memory_locked) system::releaseMemory();
}

Pacer::Pacer(const PacingSettings& settings)
    : period_ns_(std::max<std::int64_t>(1, std::llround(settings.period_s * 1e9))),
      spin_ns_(std::llround(settings.spin_s * 1e9)),
      start_ns_(monotonicNs() + period_ns_) {}

Pacer::Wake Pacer::waitForNext() noexcept {
  const std::int64_t due = start_ns_ + static_cast<std::int64_t>(next_) * period_ns_;
  if (due - spin_ns_ > monotonicNs()) system::sleepUntil(due - spin_ns_);
  std::int64_t now = monotonicNs();
  while (now < due) now = monotonicNs();
  const auto missed = static_cast<std::uint64_t>((now - due) / period_ns_);
  const std::uint64_t tick = next_ + missed;
  next_ = tick + 1;
  return {tick, now - due, missed};
}

}  // namespace palpate::servo
