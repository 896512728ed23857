// The seam between the servo and a device in the hand: it returns a position once a tick, and gets a force.
//
// A device is a few functions and a few facts. Scripted paths, mice and hardware drivers implement it alike; the servo
// knows nothing else. Drivers convert their own units and axes here, at their edge: inside it is mm and N in the body
// frame. Back ends by name, and the reasons of failures: device/back_ends.h.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/scene/safety_settings.h"

namespace palpate::device {

/// Bits of faults that stop a device from being used now. While one is set it has no position, and any force becomes
/// zero.
enum FaultBit : std::uint32_t {
  kNoPose = 1u << 0,         ///< no position yet, or one that is not a number
  kStalePose = 1u << 1,      ///< the newest position is older than kMaxPoseTicks
  kDriverError = 1u << 2,    ///< the driver reported an error; Device::explain describes it
  kNotCalibrated = 1u << 3,  ///< it does not know where it is: it wants to be moved or put back by hand
  kClosed = 1u << 4,
};

/// Bits of what a device reports while it goes on working: the tick counts them, and no one has to act.
enum NoteBit : std::uint32_t {
  kWarmMotors = 1u << 0,
  kForceExceeded = 1u << 1,     ///< the driver shortened the force
  kVelocityExceeded = 1u << 2,  ///< the hand was too quick for the driver's own guard
  kForceLimited = 1u << 3,      ///< another complaint about the force: an impulse, a ramp
};

/// Returned by read_tip when the position is unknown: NaN.
inline const Vec3 kNoPlace = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());

/// A position may be this many ticks old and is still one; a force is forgotten likewise.
inline constexpr std::uint64_t kMaxPoseTicks = 2;

/// Source of a device's rhythm.
enum class Rhythm : std::uint8_t {
  on_call,     ///< values in memory: it answers immediately, at any rate
  self_paced,  ///< the driver has a loop of its own, at `rate_hz`
  blocking,    ///< each exchange waits for the hardware, on a thread next to the servo
};

/// Reported by a device. 0 and an empty box: not reported.
struct Capabilities {
  bool takes_force = false;
  double max_force_n = 0.0;
  double continuous_force_n = 0.0;          ///< sustained for long
  double nominal_stiffness_n_per_mm = 0.0;  ///< the stiffest wall that it renders well
  Box3 workspace_mm;                        ///< reach, in the body frame
  double rate_hz = 0.0;
  int delay_ticks = 0;  ///< servo ticks from a position to its force at the motors, apart from the tick itself
  Rhythm rhythm = Rhythm::on_call;
  /// Its row of the table (device_profile.h), overriding the scene; unknown: the scene's.
  scene::DeviceModel kind = scene::DeviceModel::unknown;
  /// max_force_n is its maker's published value for this type, from our own table. Never from a driver or a plugin:
  /// without a kind and this, the limits of the weakest known device hold.
  bool documented = false;
  double motion_scale = 1.0;  ///< mm of the body a mm of the device (workspace.h): what it renders is stiffer by it
  std::string model;          ///< the device's own name
  std::string version;        ///< driver version
};

/// Read together with the position of the last read_tip.
struct DeviceState {
  Vec3 velocity = Vec3::Zero();  ///< mm/s, reported by the driver
  std::uint32_t buttons = 0;     ///< bit 0 is the first
  std::uint32_t faults = 0;      ///< FaultBits
  std::uint32_t notes = 0;       ///< NoteBits
  std::uint64_t age_ticks = 0;   ///< age of the position
  /// Ticks between sending a force and the first position that was read after the driver had it; 0: not seen yet.
  std::uint64_t loop_ticks = 0;
  // Set by the workspace (workspace.h).
  bool clutched = false;   ///< the device moves and its finger does not: no force
  bool elsewhere = false;  ///< the finger was put elsewhere in this tick: it forgets what it touched
  bool stops = false;      ///< its button for the emergency stop is down
};

/// read_tip, write_force and state are called from the servo thread, read before write, once a tick. They must return
/// within a fraction of the tick and must not throw, lock or allocate. The others are for a thread that may wait.
struct Device {
  std::string name = {};
  /// Position of the finger tip at a tick, mm. `tick` counts deadlines from 0, skipped ones included: scripts follow
  /// it, hardware ignores it. Not a number means that the device has no position now.
  std::function<Vec3(std::uint64_t tick)> read_tip = {};
  /// Takes the force that acts on the hand, N. May be empty for a device that only points.
  std::function<void(const Vec3& force)> write_force = {};
  Capabilities capabilities = {};
  /// Empty for a device that never has faults or reports.
  std::function<DeviceState()> state = {};
  /// Describes the present fault; empty text: none. May be empty.
  std::function<std::string()> explain = {};
  /// Looks for a device that was lost and opens it again; true when it is there. May be empty.
  std::function<bool()> revive = {};
  /// One exchange of a blocking driver that was opened without a thread of its own. Otherwise empty.
  std::function<void()> exchange = {};
  /// Zero force, and the driver is released. Dropping the last copy of a device does it too. May be empty.
  std::function<void()> close = {};
};

// A device that replays positions: the same tick always returns the same tip, which makes runs repeatable.

/// Tip of tick k is `tips[k]`; after the last one it rests there. Takes the forces and drops them. Throws Error for no
/// tips.
Device scriptedDevice(std::string name, std::shared_ptr<const std::vector<Vec3>> tips);

}  // namespace palpate::device
