// A thread for a driver whose every call waits for its hardware: the work again and again at a rate, outside the servo.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <thread>

namespace palpate::device {

/// A lock for a driver's thread and those who now and then want something of its driver: who waits is next. A thread
/// that gives a plain mutex back and takes it again at once can keep others out for as long as it likes.
class Turns {
 public:
  void lock() {
    const std::lock_guard next(next_);
    now_.lock();
  }
  void unlock() { now_.unlock(); }

 private:
  std::mutex next_;
  std::mutex now_;
};

class DriverThread {
 public:
  /// Starts at once, with real-time priority if the system allows it. `work` must not throw.
  DriverThread(std::function<void()> work, double rate_hz);
  /// Waits for the current work.
  ~DriverThread();
  DriverThread(const DriverThread&) = delete;
  DriverThread& operator=(const DriverThread&) = delete;

 private:
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace palpate::device
