// Wakes a thread at absolute points in time, a thousand times a second, as exactly as the system permits.
//
// Each wake-up is requested at an absolute time (no drift), slightly early, and the rest is spun away: on Linux a
// sleeping thread wakes 20 to 80 us late, a spinning one not at all. Real-time priority and locked memory are requested
// and their refusal is reported, never fatal: without them the loop runs, later at times.
#pragma once

#include <cstdint>

#include "palpate/base/system/thread.h"

namespace palpate::servo {

struct PacingSettings {
  double period_s = 0.001;
  /// Spun away before each tick, s. 100 us costs a tenth of a core and removes the wake-up error on an idle machine.
  double spin_s = 100e-6;
  bool realtime = true;  ///< ask for a priority before ordinary work, locked memory and exact timers
  int realtime_priority =
      80;  ///< priority in SCHED_FIFO: above ordinary real-time work (50), below the kernel's own watchdogs (99)
};

using PacingGrant = system::ThreadGrant;

/// Prepares the calling thread (and, for memory, its process). Never fails.
PacingGrant prepareServoThread(const PacingSettings& settings);

/// Undoes the process-wide part of prepareServoThread.
void releaseServoMemory(const PacingGrant& grant);

/// One paced thread. Tick k is due at start + k periods; whole periods that were slept through are skipped, not made
/// up.
class Pacer {
 public:
  struct Wake {
    std::uint64_t tick = 0;    ///< number of the deadline that has come
    std::int64_t late_ns = 0;  ///< time since that deadline
    std::uint64_t missed = 0;  ///< deadlines skipped since the last wake
  };
  /// The first deadline is one period from now.
  explicit Pacer(const PacingSettings& settings);
  Wake waitForNext() noexcept;

 private:
  std::int64_t period_ns_;
  std::int64_t spin_ns_;
  std::int64_t start_ns_;
  std::uint64_t next_ = 0;
};

}  // namespace palpate::servo
