// Wakes at absolute times and skips those that were slept through. The priority is the servo's: the position that a
// tick needs is read here.
#include "palpate/device/detail/driver_thread.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "palpate/base/stopwatch.h"
#include "palpate/base/system/thread.h"

namespace palpate::device {

namespace {

constexpr int kPriority = 80;  // servo::PacingSettings

}  // namespace

DriverThread::DriverThread(std::function<void()> work, double rate_hz) {
  thread_ = std::thread([this, work = std::move(work), rate_hz] {
    system::askForRealtimePriority(kPriority);
    const auto period = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1.0 / rate_hz));
    for (auto due = Clock::now(); !stop_.load(std::memory_order_relaxed);) {
      work();
      due = std::max(due + period, Clock::now() - period);
      std::this_thread::sleep_until(due);
    }
  });
}

DriverThread::~DriverThread() {
  stop_.store(true, std::memory_order_relaxed);
  thread_.join();
}

}  // namespace palpate::device
