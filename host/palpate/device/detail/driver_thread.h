// A thread for a driver whose every call waits for its hardware: the work again and again at a rate, beside the servo.
#pragma once

#include <atomic>
#include <functional>
#include <thread>

namespace palpate::device {

class DriverThread {
 public:
  /// Starts at once, with real-time priority where the system grants it. `work` must not throw.
  DriverThread(std::function<void()> work, double rate_hz);
  /// Waits for the work at hand.
  ~DriverThread();
  DriverThread(const DriverThread&) = delete;
  DriverThread& operator=(const DriverThread&) = delete;

 private:
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace palpate::device
