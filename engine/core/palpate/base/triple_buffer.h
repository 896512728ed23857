// Hands the newest value from one thread to another without either waiting: the servo publishes a thousand times a
// second, the display looks sixty times a second and always sees one whole, newest value.
//
// Three slots: the writer owns one, the reader owns one, the third changes hands through one atomic exchange.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "palpate/base/aligned.h"

namespace palpate {

/// One writer thread, one reader thread. T is copied by assignment, so it must not allocate in the writer's `publish`.
template <class T>
class TripleBuffer {
 public:
  TripleBuffer() = default;
  explicit TripleBuffer(const T& initial) : slots_{Slot{initial}, Slot{initial}, Slot{initial}} {}

  /// Writer: makes `value` the newest.
  void publish(const T& value) {
    slots_[back_].value = value;
    back_ = shared_.exchange(static_cast<std::uint8_t>(back_ | kFresh), std::memory_order_acq_rel) & kIndex;
  }

  /// Reader: the newest value that was published. The reference stays valid, and unchanged, until the next call.
  const T& newest() {
    if (shared_.load(std::memory_order_relaxed) & kFresh) {
      front_ = shared_.exchange(front_, std::memory_order_acq_rel) & kIndex;
    }
    return slots_[front_].value;
  }

 private:
  static constexpr std::uint8_t kIndex = 3;
  static constexpr std::uint8_t kFresh = 4;
  struct alignas(kCacheLineBytes) Slot {
    T value{};
  };
  std::array<Slot, 3> slots_{};
  alignas(kCacheLineBytes) std::atomic<std::uint8_t> shared_{1};
  alignas(kCacheLineBytes) std::uint8_t back_ = 0;
  alignas(kCacheLineBytes) std::uint8_t front_ = 2;
};

}  // namespace palpate
