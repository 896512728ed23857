// The mouse's fingers on the present world: engine::ServoThread with two mouse devices.
//
//   display ─ FingerTarget (triple buffer) ─► MouseLink ─ tip ─► servo tick ─ contacts, samples, vitals ─► display
#pragma once

#include <array>
#include <memory>
#include <string_view>

#include "palpate/device/mouse_finger.h"
#include "palpate/engine/servo_thread.h"

namespace palpate::viewer {

inline constexpr std::size_t kFingers = 2;
/// In recordings.
inline constexpr std::array<std::string_view, kFingers> kFingerNames = {"left", "right"};

/// The plan for a world with the settings of a scene: the first two fingers' radii, a fingertip where there are fewer.
/// Throws Error for settings that make no sense.
engine::ServoPlan planFor(std::shared_ptr<const scene::World> world, const scene::Scene& scene, bool other_body);

/// The radius of a mouse finger of a scene as it is drawn and felt, mm.
double fingerRadius(const scene::Scene& scene, std::size_t finger);

/// Belongs to the display's thread.
class LiveServo {
 public:
  explicit LiveServo(engine::ServoPlan plan);

  void point(std::size_t finger, const device::FingerTarget& target) { links_[finger].target.publish(target); }
  engine::ServoThread& thread() { return thread_; }

 private:
  std::array<device::MouseLink, kFingers> links_;
  engine::ServoThread thread_;  // last: it reads the links
};

}  // namespace palpate::viewer
