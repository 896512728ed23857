// The fingers of a scene on their scripted or recorded paths, ready for a loop.
#pragma once

#include "palpate/device/finger_path.h"
#include "palpate/scene/world.h"
#include "palpate/servo/tick.h"
#include "palpate/trace/forces_rows.h"

namespace palpate::servo {

/// One chain a finger of the scene, in its order. The world must outlive the rig. Throws Error for contact settings
/// that make no sense.
Rig scriptedRig(const scene::World& world, const device::FingerPaths& paths);

/// Settings of forces.csv for a run of that rig.
trace::ForcesCsvSettings forcesSettings(const scene::World& world, const device::FingerPaths& paths);

}  // namespace palpate::servo
