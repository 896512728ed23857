// Deadline k is start + k periods in whole nanoseconds: nothing adds up. Sleep on the monotonic clock to an absolute
// time, so a sleep that was interrupted is just asked for again; the rest by reading the clock.
#include "palpate/servo/pacing.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <thread>

#ifdef __linux__
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <time.h>
#endif

#include <cerrno>

#include "palpate/base/stopwatch.h"

namespace palpate::servo {

namespace {

void addNote(PacingGrant& grant, const char* what, int error) {
  if (!grant.note.empty()) grant.note += "; ";
  grant.note += what;
  grant.note += " refused: ";
  grant.note += std::strerror(error);
}

void sleepUntil(std::int64_t ns) noexcept {
#ifdef __linux__
  const timespec when{ns / 1'000'000'000, ns % 1'000'000'000};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &when, nullptr) == EINTR) {
  }
#else
  std::this_thread::sleep_until(Clock::time_point(std::chrono::nanoseconds(ns)));
#endif
}

}  // namespace

#ifdef __linux__

PacingGrant prepareServoThread(const PacingSettings& settings) {
  PacingGrant grant;
  if (!settings.realtime) {
    grant.note = "real-time scheduling not asked for";
    return grant;
  }
  // The default slack lets the kernel deliver a timer up to 50 us late; 1 ns needs no privilege.
  grant.exact_timers = prctl(PR_SET_TIMERSLACK, 1) == 0;
  if (!grant.exact_timers) addNote(grant, "timer slack of 1 ns", errno);
  sched_param priority{};
  priority.sched_priority = settings.realtime_priority;
  const int refused = pthread_setschedparam(pthread_self(), SCHED_FIFO, &priority);
  grant.fifo = refused == 0;
  if (!grant.fifo) addNote(grant, "SCHED_FIFO", refused);
  // Not MCL_FUTURE: under a memory limit it makes later allocations of the whole process fail.
  grant.memory_locked = mlockall(MCL_CURRENT) == 0;
  if (!grant.memory_locked) addNote(grant, "mlockall", errno);
  return grant;
}

void releaseServoMemory(const PacingGrant& grant) {
  if (grant.memory_locked) munlockall();
}

#else

PacingGrant prepareServoThread(const PacingSettings&) {
  PacingGrant grant;
  grant.note = "real-time scheduling is available on Linux only";
  return grant;
}

void releaseServoMemory(const PacingGrant&) {}

#endif

Pacer::Pacer(const PacingSettings& settings)
    : period_ns_(std::max<std::int64_t>(1, std::llround(settings.period_s * 1e9))),
      spin_ns_(std::llround(settings.spin_s * 1e9)),
      start_ns_(monotonicNs() + period_ns_) {}

Pacer::Wake Pacer::waitForNext() noexcept {
  const std::int64_t due = start_ns_ + static_cast<std::int64_t>(next_) * period_ns_;
  if (due - spin_ns_ > monotonicNs()) sleepUntil(due - spin_ns_);
  std::int64_t now = monotonicNs();
  while (now < due) now = monotonicNs();
  const auto missed = static_cast<std::uint64_t>((now - due) / period_ns_);
  const std::uint64_t tick = next_ + missed;
  next_ = tick + 1;
  return {tick, now - due, missed};
}

}  // namespace palpate::servo
