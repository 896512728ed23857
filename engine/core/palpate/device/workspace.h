// The workspace of a hand in the body: turned, scaled, moved; and the clutch, by which a hand at the end of its
// workspace goes back without its finger.
//
//   driver ─ place ─► read: turned, scaled, moved, clutched ─ tip ─► servo ─ force ─► turned back ─► driver
//
// A motion is scaled and a force is not (Capabilities::motion_scale). Jumps of the finger other than by the hand,
// through a changed workspace or a clutch, are without force, and the start rule holds afterwards: the servo's tick
// does that (DeviceState::clutched, ::elsewhere).
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string_view>

#include "palpate/base/triple_buffer.h"
#include "palpate/base/vec.h"
#include "palpate/device/device.h"
#include "palpate/device/device_frame.h"
#include "palpate/scene/world.h"

namespace palpate::device {

/// body = origin + scale * rotation * device.
struct Workspace {
  DeviceFrame frame;
  std::uint32_t clutch_buttons = 0;  ///< bits of DeviceState::buttons: while one is down, the device moves alone
  std::uint32_t stop_buttons = 0;    ///< press the emergency stop

  friend bool operator==(const Workspace& a, const Workspace& b) noexcept {
    return a.frame.axes == b.frame.axes && a.frame.mm == b.frame.mm && a.frame.origin_mm == b.frame.origin_mm &&
           a.clutch_buttons == b.clutch_buttons && a.stop_buttons == b.stop_buttons;
  }
};

/// About x, then y, then z, in degrees, as a scene has it.
Mat3 rotationOf(const Vec3& turn_deg);
Vec3 turnOf(const Mat3& rotation);

/// The scene's workspace; `origin_mm` where it has no origin.
Workspace workspaceOf(const scene::DeviceSettings& settings, const Vec3& origin_mm);

/// The scene's settings for the device named `words` on this finger (0 the first): the finger's own table, else the
/// one for another finger, else none.
std::optional<scene::DeviceSettings> settingsOf(const scene::Scene& scene, std::string_view words, std::size_t finger);

/// Mouse, script and playback: their places are the body's own, so their origin is, too.
bool givesPlacesOfTheBody(std::string_view words);

/// Default origin of a device: next to the place where a path by itself begins, the first finger 30 mm left of it, the
/// second as far right. Zero for devices that give places of the body (mouse, script, playback).
Vec3 standardOrigin(const scene::World& world, std::string_view words, std::size_t finger);

/// The clutch's movement so far.
struct ClutchState {
  Vec3 shift_mm = Vec3::Zero();  ///< shift of the finger, beyond the workspace's origin
  Vec3 tip = kNoPlace;           ///< place of the finger, fixed while the clutch is held; none before the first tick
  bool held = false;
};

/// Place of the finger, mm of the body. While the clutch is held it stays where it was, and continues from there on
/// release. Not a number where `place` is not finite; the clutch then stays unchanged.
Vec3 clutchedTip(ClutchState& state, const DeviceFrame& frame, const Vec3& place, bool clutch) noexcept;

/// The part of a device's state in this tick that a display may read.
struct WorkspaceReading {
  Vec3 place = kNoPlace;         ///< reported by the device, before the workspace
  Vec3 tip = kNoPlace;           ///< in the body frame
  Vec3 shift_mm = Vec3::Zero();  ///< shift by the clutch
  std::uint64_t fresh = 0;       ///< number of ticks with a new position
  Vec3 force = Vec3::Zero();     ///< force on the hand in the tick before, in the body frame, N
  DeviceState state;
};

/// One device between the display and the servo.
class WorkspaceLink {
 public:
  explicit WorkspaceLink(const Workspace& workspace) : workspace_(workspace), at_work_(workspace) {}

  // Display's thread.

  /// Another place for the device's space: from the next tick on, without force until the tip was outside.
  void place(const Workspace& workspace) { workspace_.publish(workspace); }
  /// The same as the device's own button.
  void clutch(bool held) noexcept { clutch_.store(held, std::memory_order_relaxed); }
  const WorkspaceReading& reading() { return reading_.newest(); }

  // Servo's thread, once a tick: read, then the others. No allocation, lock or exception.

  Vec3 read(const Vec3& place, const DeviceState& state) noexcept;
  /// In the device's axes; zero while the clutch is held.
  Vec3 forceForDevice(const Vec3& force) noexcept;
  const DeviceState& state() const noexcept { return now_.state; }

 private:
  void adoptWorkspace() noexcept;

  TripleBuffer<Workspace> workspace_;
  std::atomic<bool> clutch_{false};
  TripleBuffer<WorkspaceReading> reading_;

  // the servo's
  Workspace at_work_;
  ClutchState clutch_state_;
  WorkspaceReading now_;
};

/// The device as the servo gets it. Its capabilities are those in the workspace of now: the reach as a box round the
/// turned one, the scale of its motion.
Device inWorkspace(const Device& device, const Workspace& workspace, const std::shared_ptr<WorkspaceLink>& link);

/// The corners of a device's reach, in the body; empty if it is unknown. Corner i has the high x, y, z where the bits
/// 1, 2, 4 of i are set.
std::vector<Vec3> reachOf(const Capabilities& device, const DeviceFrame& frame);

}  // namespace palpate::device
