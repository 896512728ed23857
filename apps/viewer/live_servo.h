// The mouse's fingers on the present world: engine::ServoThread with two mouse devices, or others in their place.
//
//   display ─ FingerTarget (triple buffer) ─► MouseLink ─ tip ─► servo tick ─ contacts, samples, vitals ─► display
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "palpate/device/mouse_finger.h"
#include "palpate/engine/servo_thread.h"

namespace palpate::viewer {

inline constexpr std::size_t kFingers = 2;
/// In recordings.
inline constexpr std::array<std::string_view, kFingers> kFingerNames = {"left", "right"};

/// The plan for a world with the settings of a scene: the first two fingers' radii, a fingertip where there are fewer.
/// A mouse pushes nobody's hand and has no limits; where hardware is held, the scene's hold for all fingers, and those
/// that the hardware names itself. Throws Error for settings that make no sense.
engine::ServoPlan planFor(std::shared_ptr<const scene::World> world, const scene::Scene& scene, bool other_body,
                          const std::optional<device::Capabilities>& held = {});

/// The least force and stiffness that the devices name (0: none does); nothing without devices.
std::optional<device::Capabilities> leastOf(std::span<const device::Device> devices);

/// The radius of a mouse finger of a scene as it is drawn and felt, mm.
double fingerRadius(const scene::Scene& scene, std::size_t finger);

/// Belongs to the display's thread.
class LiveServo {
 public:
  /// The first fingers are held by the devices, the others by the mouse.
  explicit LiveServo(engine::ServoPlan plan, std::vector<device::Device> devices = {});

  void point(std::size_t finger, const device::FingerTarget& target) { links_[finger].target.publish(target); }
  engine::ServoThread& thread() { return thread_; }
  /// A device has the finger, the mouse has not.
  bool isHeld(std::size_t finger) const { return finger < devices_.size(); }
  const std::vector<device::Device>& devices() const { return devices_; }

 private:
  std::array<device::MouseLink, kFingers> links_;
  std::vector<device::Device> devices_;
  engine::ServoThread thread_;  // last: it reads the links
};

}  // namespace palpate::viewer
