// A queue between two threads that never waits: the servo drops a sample rather than miss a tick, and counts what it
// dropped.
#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <vector>

#include "palpate/base/aligned.h"

namespace palpate {

/// One producer thread, one consumer thread, a capacity fixed at construction (rounded up to a power of two).
template <class T>
class RingBuffer {
 public:
  explicit RingBuffer(std::size_t capacity) : slots_(std::bit_ceil(capacity < 1 ? 1 : capacity)) {}

  /// Producer: false, and counted, when the queue is full.
  bool push(const T& value) {
    return pushWith([&](T& slot) { slot = value; });
  }

  /// Producer: the same; `fill` writes the value in place, which saves a copy of a large one.
  template <class Fill>
  bool pushWith(const Fill& fill) {
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    if (tail - head_.load(std::memory_order_acquire) == slots_.size()) {
      dropped_.fetch_add(1, std::memory_order_relaxed);
      return false;
    }
    fill(slots_[tail & (slots_.size() - 1)]);
    tail_.store(tail + 1, std::memory_order_release);
    return true;
  }

  /// Consumer: false when the queue is empty.
  bool pop(T& value) {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    if (head == tail_.load(std::memory_order_acquire)) return false;
    value = slots_[head & (slots_.size() - 1)];
    head_.store(head + 1, std::memory_order_release);
    return true;
  }

  std::size_t capacity() const { return slots_.size(); }
  std::size_t dropped() const { return dropped_.load(std::memory_order_relaxed); }

 private:
  std::vector<T> slots_;
  alignas(kCacheLineBytes) std::atomic<std::size_t> head_{0};
  alignas(kCacheLineBytes) std::atomic<std::size_t> tail_{0};
  std::atomic<std::size_t> dropped_{0};
};

}  // namespace palpate
