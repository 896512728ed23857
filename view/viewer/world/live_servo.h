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

/// A device that is open, and where its space lies in the body.
struct OpenedDevice {
  std::string words;  ///< as it was asked for: "openhaptics:Left"
  device::Device device;
  device::Workspace workspace;
};

/// The plan for a world with the settings of a scene: the first two fingers' radii, a fingertip where there are fewer.
/// A mouse pushes nobody's hand and has no limits; where hardware is held, the scene's hold for all fingers, and those
/// of the weakest device (device/device_profile.h). `tick_s` is the servo's; 0: as the scene says. Throws Error for
/// settings that make no sense.
engine::ServoPlan planFor(std::shared_ptr<const scene::World> world, const scene::Scene& scene, bool other_body,
                          std::span<const device::Capabilities> held = {}, double tick_s = 0.0);

/// As its workspace makes it: what the limits are taken from.
device::Capabilities abilityOf(const OpenedDevice& opened);
std::vector<device::Capabilities> abilitiesOf(const std::vector<OpenedDevice>& devices);

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

  /// The device takes the finger; one that held it goes. The plan must have its limits.
  void hold(std::size_t finger, OpenedDevice opened, engine::ServoPlan plan);
  /// The mouse takes the finger back.
  void letGo(std::size_t finger, engine::ServoPlan plan);
  /// Devices that were let go and that the servo has given back: dropping them closes their drivers, which may take
  /// its time.
  std::vector<device::Device> takeLeaving();

  /// A device has the finger, the mouse has not.
  bool isHeld(std::size_t finger) const { return held_[finger].has_value(); }
  bool anyHeld() const { return isHeld(0) || isHeld(1); }
  /// Of a finger that is held: the device as it was opened, before its workspace.
  const OpenedDevice& opened(std::size_t finger) const { return held_[finger]->opened; }
  /// Of a finger that is held: the device as the servo has it.
  const device::Device& device(std::size_t finger) const { return held_[finger]->placed; }
  /// Of the devices that hold fingers; the same if this finger were held by that device, or for null by the mouse.
  std::vector<device::Capabilities> abilities() const;
  std::vector<device::Capabilities> abilitiesWith(std::size_t finger, const OpenedDevice* opened) const;

  // Of a finger that is held; nothing happens to another.

  /// The device's space lies elsewhere. True if it was not there already; the plan's limits may have to follow.
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
