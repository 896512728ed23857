// World + paths -> a chain a finger. Load time.
#include "palpate/servo/scripted_rig.h"

#include <utility>

#include "palpate/device/device.h"
#include "palpate/servo/device_limits.h"

namespace palpate::servo {

Rig scriptedRig(const scene::World& world, const device::FingerPaths& paths) {
  RigParts parts;
  parts.tick_s = 1.0 / world.scene.ticks_per_s;
  parts.limiter = limiterSettings(world);
  parts.solvers = makeSolvers(world.surface, world.hdb, world.scene.fingers.size(), world.breath);
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
