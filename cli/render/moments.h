// The fingers of a scene at chosen moments: runs it without a device, as fast as it goes, and keeps what is asked for.
#pragma once

#include <span>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/device/finger_path.h"
#include "palpate/scene/world.h"
#include "palpate/servo/loop.h"

namespace palpate::app {

/// One frame a time; times count from the first tick and must not fall. Throws Error for a time after the run's end.
std::vector<servo::TickSamples> framesAt(const scene::World& world, const device::FingerPaths& paths,
                                         std::span<const double> times_s, const Progress& progress);

/// Places, at least one, mm: the finger's tip goes to the first and on to the others.
using Pose = std::vector<Vec3>;

/// Puts so many fingers, one a pose, into the scene, in place of its own.
void useFingersAt(std::size_t poses, double radius_mm, scene::Scene& scene);

/// The paths of these fingers: from outside the skin, square to it, to the first place, and on.
device::FingerPaths pathsToPoses(const scene::World& world, std::span<const Pose> poses);

}  // namespace palpate::app
