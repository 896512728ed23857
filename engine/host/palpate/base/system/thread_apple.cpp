// macOS: compiled, never run. Its constraint policy for threads would be the way to real time.
#include <chrono>
#include <thread>

#include "palpate/base/stopwatch.h"
#include "palpate/base/system/thread.h"

namespace palpate::system {

ThreadGrant askForRealtime(int) {
  ThreadGrant grant;
  grant.note = "real-time scheduling is available on Linux and Windows only";
  return grant;
}

void askForRealtimePriority(int) {}

void releaseMemory() {}

void sleepUntil(std::int64_t ns) noexcept {
  std::this_thread::sleep_until(Clock::time_point(std::chrono::nanoseconds(ns)));
}

void lowerPriority(int) {}

}  // namespace palpate::system
