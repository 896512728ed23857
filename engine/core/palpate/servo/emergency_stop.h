// The emergency stop: may be pressed from any thread or a signal handler; the next tick of every finger sends no force,
// and none is sent until the stop is released on purpose.
//
//   key, button, signal, API ─ press ─► one flag ─► runTick reads it once a tick ─► zero force, kEmergencyStop
//
// Forces do not fade: what a hand does when a force ends at once is hardly less than when it ends in a tenth of a
// second (docs/explanation/safety.md), and what ends at once ends for certain.
#pragma once

#include <atomic>

namespace palpate::servo {

class EmergencyStop {
 public:
  /// Lock-free, so it is allowed in a signal handler.
  void press() noexcept { pressed_.store(true, std::memory_order_release); }
  /// Forces come back by the start rule only: where the tip is inside, not before it has been outside.
  void release() noexcept { pressed_.store(false, std::memory_order_release); }
  bool pressed() const noexcept { return pressed_.load(std::memory_order_acquire); }

 private:
  std::atomic<bool> pressed_{false};
  static_assert(std::atomic<bool>::is_always_lock_free);
};

}  // namespace palpate::servo
