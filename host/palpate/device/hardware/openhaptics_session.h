// All OpenHaptics devices of this program on the library's one scheduler: initialised before it starts, one frame a
// device and tick, zero force before it stops.
//
//   scheduler's thread: for each device: begin frame ─ position ─ DriverLink ─ force ─ end frame ─ errors
//   any other:          add, release, revive: the scheduler stands still meanwhile, and forces are zero
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/device/back_ends.h"
#include "palpate/device/detail/driver_link.h"
#include "palpate/device/device_frame.h"
#include "palpate/device/hardware/openhaptics_api.h"

namespace palpate::device::openhaptics {

/// One device on the scheduler. What has no other remark belongs to the scheduler's thread while it runs.
/// The kind of device that calls itself so: "PHANTOM Omni". Unknown for a name that is not listed.
scene::DeviceModel kindOf(std::string_view model);

struct Slot {
  Slot(const DriverLinkSettings& settings, const DeviceFrame& place) : frame(place), link(settings) {}

  std::string name;  ///< that it was initialised by; "" for the default device
  Handle handle = kInvalidHandle;
  DeviceFrame frame;
  Capabilities capabilities;
  DriverLink link;
  std::atomic<std::uint32_t> last_error{kSuccess};
  std::atomic<std::uint64_t> frames{0};
  std::atomic<std::uint64_t> frames_at_rest{0};  ///< with zero force, since it was muted
  std::uint32_t faults = 0;                      ///< of errors that named this device
  std::uint32_t notes = 0;
  std::uint32_t calibration = kCalibrated;
  bool held = false;  ///< by a Device; guarded by the session's mutex
};

/// A device, or why there is none.
struct Added {
  std::shared_ptr<Slot> slot;
  std::string reason;
  std::string remedy;
};

class Session {
 public:
  explicit Session(const Api& api) : api_(api) {}
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Initialises a device and puts it on the scheduler. Throws Error for axes that are none.
  Added add(const OpenOptions& options);
  /// Zero force at once; the driver lets the device go with the last of them.
  void release(const std::shared_ptr<Slot>& slot);
  /// Initialises a lost device anew; true when the driver has it again. Not while another finger feels: the scheduler
  /// would have to stop under it.
  bool revive(Slot& slot);
  /// What is wrong with it now, in words; empty: nothing.
  std::string explain(const Slot& slot) const;
  /// The library's words for an error, with ours.
  std::string describe(std::uint32_t code) const;
  /// Names of the devices that are held.
  std::vector<std::string> heldDevices();

 private:
  static std::uint32_t onTick(void* session);
  void serve(Slot& slot) noexcept;
  void checkCalibration(Slot& slot) noexcept;
  void takeErrors(Slot& slot) noexcept;
  Added initialise(const OpenOptions& options, const DeviceFrame& frame);
  Handle firstFree(const OpenOptions& options, std::string& name, std::uint32_t& error);
  Capabilities capabilitiesOf(Handle handle, const DeviceFrame& frame) const;
  bool isOnScheduler(Handle handle) const;
  bool anotherFeels(const Slot& slot) const;
  void waitForRest(const Slot& slot) const;
  std::uint32_t firstError() const;
  std::uint32_t start();
  void stop();
  void letGo();

  Api api_;
  std::mutex mutex_;  // of add, release and revive
  std::vector<std::shared_ptr<Slot>> slots_;
  unsigned long schedule_ = 0;
  bool running_ = false;
};

/// The library of these options with its functions; `missing` names those that it should have and has not.
struct Loaded {
  SharedLibrary library;
  Api api;
  std::vector<std::string> missing;
};
Loaded load(const OpenOptions& options);

/// The session of a library, shared by all devices that are open.
std::shared_ptr<Session> sessionOf(const Loaded& loaded);

}  // namespace palpate::device::openhaptics
