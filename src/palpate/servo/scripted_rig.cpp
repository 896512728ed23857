// World + paths -> a chain a finger. The limiter's stiffness is the stiffest vertex times the steepest that the force
// law can get within the deepest press: ordinary contact never meets its slew limit. Load time. Own.
#include "palpate/servo/scripted_rig.h"

#include <algorithm>
#include <utility>

#include "palpate/device/device.h"

namespace palpate::servo {

LimiterSettings limiterSettings(const scene::World& world) {
  LimiterSettings settings;
  settings.safety = world.scene.safety;
  settings.stiffness_n_per_mm =
      *std::max_element(world.stiffness_n_per_mm.begin(), world.stiffness_n_per_mm.end()) *
      tissue::steepestFactor(world.surface.force_law, world.scene.contact.finger.max_depth_mm);
  settings.tick_s = 1.0 / world.scene.ticks_per_s;
  return settings;
}

Rig scriptedRig(const scene::World& world, const device::FingerPaths& paths) {
  RigParts parts;
  parts.tick_s = 1.0 / world.scene.ticks_per_s;
  parts.limiter = limiterSettings(world);
  parts.solvers = makeSolvers(world.surface, world.hdb, world.scene.fingers.size());
  for (const scene::Finger& finger : world.scene.fingers) {
    parts.devices.push_back(device::scriptedDevice(finger.name, paths.tips[parts.fingers.size()]));
    parts.fingers.push_back(scene::contactSettings(world.scene, finger));
    contact::check(parts.fingers.back());
  }
  return rigOf(std::move(parts));
}

trace::ForcesCsvSettings forcesSettings(const scene::World& world, const device::FingerPaths& paths) {
  trace::ForcesCsvSettings settings;
  for (const scene::Finger& finger : world.scene.fingers) settings.finger_names.push_back(finger.name);
  settings.start_s = paths.start_s;
  settings.ticks_per_s = world.scene.ticks_per_s;
  return settings;
}

}  // namespace palpate::servo
