// The fingers on the present world: engine::ServoThread with two mouse devices, or others in their place, which come
// and go while it runs.
//
//   display ─ FingerTarget (triple buffer) ─► MouseLink ─ tip ─► servo tick ─ contacts, samples, vitals ─► display
//   device ─ WorkspaceLink: turned, scaled, clutched ─────── tip ─►
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "palpate/device/mouse_finger.h"
#include "palpate/device/workspace.h"
#include "palpate/engine/servo_thread.h"
#include "view/viewer/state/fingers.h"

namespace palpate::viewer {

/// An open device, and the place of its workspace in the body.
struct OpenedDevice {
  std::string words;  ///< name in the request: "openhaptics:Left"
  device::Device device;
  device::Workspace workspace;
};

/// The plan for a world with the settings of a scene: the first two fingers' radii, a fingertip where there are fewer.
/// A mouse pushes no hand and has no limits; with hardware, the scene's hold for all fingers, and those of the weakest
/// device (device/device_profile.h). `tick_s` is the servo's; 0: the scene's. Throws Error for invalid settings.
engine::ServoPlan planFor(std::shared_ptr<const scene::World> world, const scene::Scene& scene, bool other_body,
                          std::span<const device::Capabilities> held = {}, double tick_s = 0.0);

/// Capabilities after its workspace: the source of the limits.
device::Capabilities scaledCapabilities(const OpenedDevice& opened);
std::vector<device::Capabilities> scaledCapabilities(const std::vector<OpenedDevice>& devices);

/// The radius of a mouse finger of a scene as it is drawn and felt, mm.
double fingerRadius(const scene::Scene& scene, std::size_t finger);

/// Belongs to the display's thread.
class LiveServo {
 public:
  /// The first fingers are held by the devices, the others by the mouse.
  explicit LiveServo(engine::ServoPlan plan, std::vector<OpenedDevice> devices = {});

  void point(std::size_t finger, const device::FingerTarget& target) { mice_[finger].target.publish(target); }
  engine::ServoThread& thread() { return thread_; }

  // Devices come and go while the servo runs: in one tick, with the limits of the plan, the one before at zero force.

  /// Gives the finger to the device; an earlier one is released. The plan must have its limits.
  void hold(std::size_t finger, OpenedDevice opened, engine::ServoPlan plan);
  /// Gives the finger back to the mouse.
  void release(std::size_t finger, engine::ServoPlan plan);
  /// Released devices that the servo no longer uses: dropping them closes their drivers, which may take some time.
  std::vector<device::Device> collectReleased();

  /// Whether a device, not the mouse, has the finger.
  bool isHeld(std::size_t finger) const { return held_[finger].has_value(); }
  bool anyHeld() const { return isHeld(0) || isHeld(1); }
  /// For a held finger: the device as opened, before its workspace.
  const OpenedDevice& opened(std::size_t finger) const { return held_[finger]->opened; }
  /// For a held finger: the device as the servo has it.
  const device::Device& device(std::size_t finger) const { return held_[finger]->placed; }
  /// For the devices that hold fingers; the same as if this finger were held by that device, or for null by the mouse.
  std::vector<device::Capabilities> abilities() const;
  std::vector<device::Capabilities> abilitiesWith(std::size_t finger, const OpenedDevice* opened) const;

  // For a held finger; no effect on another.

  /// Moves the device's workspace. True if it was elsewhere; the plan's limits may have to follow.
  bool place(std::size_t finger, const device::Workspace& workspace);
  void clutch(std::size_t finger, bool held);
  device::WorkspaceReading reading(std::size_t finger);

 private:
  struct Held {
    OpenedDevice opened;
    std::shared_ptr<device::WorkspaceLink> link;
    device::Device placed;
  };
  static Held heldBy(OpenedDevice opened);
  std::vector<device::Device> devicesAtFirst();
  engine::ServoThread::Guide guide();
  void leave(std::size_t finger);

  std::array<device::MouseLink, kFingers> mice_;
  std::array<std::optional<Held>, kFingers> held_;
  std::vector<device::Device> leaving_;
  engine::ServoThread thread_;  // last: it reads the links
};

}  // namespace palpate::viewer
