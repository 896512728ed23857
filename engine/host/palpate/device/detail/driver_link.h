// Between a driver's thread and the servo's: the newest reading one way, the newest force the other, neither waiting.
//
//   driver's tick: dueForce() ─► motors, sensors ─► publish()      ═ triple buffers ═      servo's tick: read(),
//   write()
//
// Each side watches the other. A servo that falls silent leaves a zero force after two of its ticks, a driver that does
// leaves no position after two; and while the driver is in trouble every force is zero on either side.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

#include "palpate/base/triple_buffer.h"
#include "palpate/base/vec.h"
#include "palpate/device/device.h"

namespace palpate::device {

/// A driver's reading in one of its ticks; mm and mm/s in the body frame.
struct DriverReading {
  Vec3 tip = Vec3::Zero();
  Vec3 velocity = Vec3::Zero();
  std::uint32_t buttons = 0;
  std::uint32_t faults = 0;
  std::uint32_t notes = 0;
};

struct DriverLinkSettings {
  double tick_s = 0.001;         ///< servo's
  double driver_rate_hz = 1000;  ///< rate of the driver's loop
  double max_force_n = 0.0;      ///< upper bound of the force; 0: none
};

/// An opened device, or the reason why not.
template <class Slot>
struct SlotOrReason {
  std::shared_ptr<Slot> slot;
  std::string reason;
  std::string remedy;
};

class DriverLink {
 public:
  explicit DriverLink(const DriverLinkSettings& settings);

  // Driver's thread, once a driver's tick. No allocation, lock or exception.

  /// The force for the motors, N in the body frame; call before the reading is published.
  Vec3 dueForce() noexcept;
  void publish(const DriverReading& reading) noexcept;

  // Servo's thread, once a servo tick: read, then write. No allocation, lock or exception.

  /// Not a number while there is a fault.
  Vec3 read(std::uint64_t tick) noexcept;
  void write(const Vec3& force) noexcept;
  const DeviceState& state() const noexcept { return state_; }

  // Any thread.

  /// From now on every force is zero.
  void mute() noexcept { muted_.store(true, std::memory_order_relaxed); }
  bool muted() const noexcept { return muted_.load(std::memory_order_relaxed); }
  /// Faults of the newest reading.
  std::uint32_t driverFaults() const noexcept { return driver_faults_.load(std::memory_order_relaxed); }

 private:
  struct Reading : DriverReading {
    std::uint64_t number = 0;  ///< counted from 1
    std::uint64_t force = 0;   ///< number of the force that the motors had
  };
  struct Force {
    Vec3 newtons = Vec3::Zero();
    std::uint64_t number = 0;
    bool safe = false;  ///< the servo had a position when it wrote this
  };

  DriverLinkSettings settings_;
  std::uint64_t silent_limit_;
  TripleBuffer<Reading> readings_{Reading{}};
  TripleBuffer<Force> forces_{Force{}};
  std::atomic<bool> muted_{false};
  std::atomic<std::uint32_t> driver_faults_{kNoPose};

  // the driver's
  std::uint64_t readings_made_ = 0;
  std::uint64_t force_at_work_ = 0;
  std::uint64_t silent_ticks_ = 0;

  // the servo's
  DeviceState state_;
  std::uint64_t last_reading_ = 0;
  std::uint64_t last_fresh_tick_ = 0;
  std::uint64_t forces_sent_ = 0;
  std::uint64_t probe_force_ = 0;  ///< the force whose way is being timed; 0: none
  std::uint64_t probe_tick_ = 0;
};

}  // namespace palpate::device
