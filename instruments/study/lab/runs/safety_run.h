// Cost of guards and passivity in a servo tick: the product's tick against one that sends the contact's force as it is.
#pragma once

#include <cstddef>

#include "palpate/device/finger_path.h"
#include "palpate/scene/world.h"

namespace palpate::bench {

/// Cost for one tick of one finger, us.
struct SafetyCost {
  double safety_us = 0.0;  ///< guards, start rule, toe, passivity, clamp, rate guard
  double tick_us = 0.0;    ///< the whole tick with them
  std::size_t blocks = 0;  ///< compared, each with the same block of the other
  double ratio() const { return tick_us > 0.0 ? safety_us / tick_us : 0.0; }
};

/// Runs blocks of the paths' ticks in turn with and without, each with its own fingers, for about `seconds`; the
/// medians. Devices take their forces, so that the controller has a loop to look after.
SafetyCost measureSafety(const scene::World& world, const device::FingerPaths& paths, double seconds);

}  // namespace palpate::bench
