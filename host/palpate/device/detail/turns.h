// A lock for a driver's thread and those who now and then want something of its driver: who waits is next. A thread
// that gives a plain mutex back and takes it again at once can keep others out for as long as it likes.
#pragma once

#include <mutex>

namespace palpate::device {

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

}  // namespace palpate::device
