// Threads that share the work of one call with the thread that calls: woken, not made, because a batch of a third of a
// millisecond is over before a thread has begun.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>

#include "interrupts.h"

namespace palpate::python {

/// Asked between ticks whether the call was interrupted: by the caller's thread the signals, by others a flag.
class Pause {
 public:
  Pause(Interrupts& interrupts, const std::atomic<bool>& stop) : interrupts_(interrupts), stop_(stop) {}
  /// Throws Interrupted.
  void check() const {
    if (stop_.load(std::memory_order_relaxed)) throw Interrupted();
    interrupts_.check();
  }

 private:
  Interrupts& interrupts_;
  const std::atomic<bool>& stop_;
};

/// Does one part; may throw Interrupted only.
using Part = std::function<void(std::size_t part, const Pause& pause)>;

/// Ticks that are worth a thread: waking one takes 60 us, a tick about 130 ns, so 0.3 ms of work.
inline constexpr std::size_t kMinTicksPerThread = 2500;

/// One call at a time. After a fork the child has none of the threads: it makes its own.
class ThreadPool {
 public:
  /// `threads` includes the caller's. None is started before there is work.
  explicit ThreadPool(std::size_t threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  std::size_t threads() const { return threads_; }
  /// Calls `work` for parts 0 to `parts` - 1, the calling thread among those who do; returns when all are done. Throws
  /// Interrupted, when no thread works any more.
  void share(std::size_t parts, const Part& work, Interrupts& interrupts);
  /// Ends the threads; the next call makes new ones.
  void close() noexcept;

 private:
  class Impl;
  std::size_t threads_;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate::python
