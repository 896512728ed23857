// One device of a plugin: a thread beside the servo calls a plugin that may wait, the servo itself one that answers at
// once. DriverLink is between them either way, so that the promises are the same.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>

#include "palpate/device/back_ends.h"
#include "palpate/device/detail/driver_link.h"
#include "palpate/device/detail/turns.h"
#include "palpate/device/device_frame.h"
#include "palpate/device/hardware/plugin_library.h"

namespace palpate::device::plugin {

/// Exchanges a second with a plugin that may wait: two to a tick of the servo, so that neither waits for the other.
inline constexpr double kExchangesPerS = 2000.0;

class Driver {
 public:
  /// Of a device that was opened, with what it can.
  Driver(const palpate_device_table& table, palpate_device_handle device, const palpate_device_capabilities& able,
         const DeviceFrame& frame, const OpenOptions& options, std::string which);
  ~Driver() { letGo(); }
  Driver(const Driver&) = delete;
  Driver& operator=(const Driver&) = delete;

  bool answersAtOnce() const { return capabilities_.rhythm == Rhythm::on_call; }
  const Capabilities& capabilities() const { return capabilities_; }

  /// Of a plugin that may wait: force out, position in.
  void exchange() noexcept;

  // The servo's thread. They ask the plugin itself where it answers at once.
  Vec3 read(std::uint64_t tick) noexcept;
  void write(const Vec3& force) noexcept;
  const DeviceState& state() const noexcept { return link_.state(); }

  /// Zero force, and the plugin lets the device go; nothing is asked of it from then on.
  void letGo() noexcept;
  /// Opens a device again that was given up; true when it is there.
  bool revive();
  /// What is wrong with it now, in words; empty: nothing.
  std::string explain();

 private:
  int tellForce(const Vec3& force) noexcept;
  /// True when there was something new.
  bool takeReading(int told) noexcept;
  void refused() noexcept;
  std::string pluginsWords() noexcept;

  const palpate_device_table& table_;
  palpate_device_handle device_;  ///< null: given up
  DeviceFrame frame_;
  Capabilities capabilities_;
  DriverLink link_;
  std::string which_;
  double tick_s_;

  Turns turns_;  ///< of all calls for a device that may wait, and of letting go
  int refusals_ = 0;
  std::atomic<bool> gone_{false};
  std::atomic<bool> servo_is_in_{false};  ///< in a plugin that answers at once
  int told_ = PALPATE_DEVICE_OK;          ///< its answer to the last force

  std::mutex words_mutex_;
  std::string trouble_;
};

/// A device, or why there is none.
struct Opened {
  std::unique_ptr<Driver> driver;
  std::string reason;
};

/// Throws Error for axes that are none.
Opened openDriver(const palpate_device_table& table, const std::string& which, const OpenOptions& options);

}  // namespace palpate::device::plugin
