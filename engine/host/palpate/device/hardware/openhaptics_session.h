// All OpenHaptics devices of this program on the library's one scheduler: initialised before it starts, one frame a
// device and tick, zero force before it stops.
//
//   scheduler's thread: for each device: begin frame ─ position ─ DriverLink ─ force ─ end frame ─ errors
//   any other:          add, release, revive: the scheduler is stopped meanwhile, and forces are zero
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/device/back_ends.h"
#include "palpate/device/calibration.h"
#include "palpate/device/detail/driver_link.h"
#include "palpate/device/device_frame.h"
#include "palpate/device/hardware/openhaptics_api.h"

namespace palpate::device::openhaptics {

/// The kind of device that calls itself so: "PHANTOM Omni". Unknown for a name that is not listed.
scene::DeviceModel findDeviceModel(std::string_view model);

/// One device on the scheduler. Members without a remark belong to the scheduler's thread while it runs.
struct Slot {
  Slot(const DriverLinkSettings& settings, const DeviceFrame& place) : frame(place), link(settings) {}

  std::string name;  ///< used to initialise it; "" for the default device
  Handle handle = kInvalidHandle;
  DeviceFrame frame;
  Capabilities capabilities;
  DriverLink link;
  std::atomic<std::uint32_t> last_error{kSuccess};
  std::atomic<std::uint64_t> frames{0};
  std::atomic<std::uint64_t> frames_at_rest{0};  ///< with zero force, since it was muted
  std::uint32_t faults = 0;                      ///< bits of errors that named this device
  std::uint32_t notes = 0;
  std::uint32_t calibration = kCalibrated;
  bool held = false;  ///< by a Device; guarded by the session's mutex
};

using Added = SlotOrReason<Slot>;

class Session {
 public:
  explicit Session(const Api& api) : api_(api) {}
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Initialises a device and puts it on the scheduler. Throws Error for invalid axes.
  Added add(const OpenOptions& options);
  /// Zero force at once; the driver releases the device with the last of them.
  void release(const std::shared_ptr<Slot>& slot);
  /// Initialises a lost device again; true when the driver has it again. Not while another finger feels: the scheduler
  /// would have to stop under it.
  bool revive(Slot& slot);
  /// Its present fault, in words; empty: none.
  std::string explain(const Slot& slot) const;
  /// The library's words for an error, with ours.
  std::string describe(std::uint32_t code) const;
  /// Names of the devices that are held.
  std::vector<std::string> heldDevices();

 private:
  static std::uint32_t onTick(void* session);
  void serve(Slot& slot) noexcept;
  void checkCalibration(Slot& slot) noexcept;
  void drainErrors(Slot& slot) noexcept;
  Added initialise(const OpenOptions& options, const DeviceFrame& frame);
  Handle firstFree(const OpenOptions& options, std::string& name, std::uint32_t& error);
  Capabilities readCapabilities(Handle handle, const DeviceFrame& frame) const;
  bool isOnScheduler(Handle handle) const;
  bool hasOtherWorkingSlot(const Slot& slot) const;
  void waitForRest(const Slot& slot) const;
  std::uint32_t firstError() const;
  std::uint32_t start();
  void stop();
  void releaseDevices();

  Api api_;
  std::mutex mutex_;  // guards add, release and revive
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
std::shared_ptr<Session> sharedSession(const Loaded& loaded);

}  // namespace palpate::device::openhaptics
