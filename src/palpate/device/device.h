// The seam between the servo and whatever a hand holds: a position comes out of it once a tick, a force goes back.
//
// A device is two functions and a few facts. Scripted paths, mice and hardware drivers fill it in alike; the servo
// knows nothing else. Drivers convert their own units and axes here, at their edge: inside it is mm and N in the body
// frame.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "palpate/base/vec.h"

namespace palpate::device {

/// Both functions are called from the servo thread, read before write, once a tick. They must return within a fraction
/// of the tick and must not throw, lock or allocate.
struct Device {
  std::string name;
  /// Position of the finger tip at a tick, mm. `tick` counts deadlines from 0, skipped ones included: scripts follow
  /// it, hardware ignores it. Not a number means that the device has no position now.
  std::function<Vec3(std::uint64_t tick)> read_tip;
  /// Takes the force that acts on the hand, N. May be empty for a device that only points.
  std::function<void(const Vec3& force)> write_force;
};

// A device that replays positions: the same tick always gives the same tip, which makes runs repeatable.

/// Tip of tick k is `tips[k]`; after the last one it rests there. Takes the forces and drops them. Throws Error for no
/// tips.
Device scriptedDevice(std::string name, std::shared_ptr<const std::vector<Vec3>> tips);

}  // namespace palpate::device
