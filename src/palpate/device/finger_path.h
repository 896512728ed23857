// Where the fingers of a scene go: from their trajectory files and scripts to one tip a tick, on one clock.
#pragma once

#include <memory>
#include <vector>

#include "palpate/device/trajectory.h"
#include "palpate/scene/world.h"

namespace palpate::device {

struct FingerPaths {
  double start_s = 0.0;   ///< time of tick 0: the earliest first row of all trajectories; scripts start there too
  std::size_t ticks = 0;  ///< until the last finger has finished, or what the scene's `seconds` says
  std::vector<std::shared_ptr<const std::vector<Vec3>>>
      tips;  ///< a finger each; a finished finger rests at its last tip
};

/// Reads the files and walks the scripts. Throws Error as readTrajectory and walkScript do.
FingerPaths pathsOf(const scene::World& world);

/// A path for a body nobody has planned one for: press, drag, circle and lift around the highest place (largest z) that
/// faces up and has room for it, along its normal, sized to the body.
Trajectory automaticPath(const scene::World& world, double radius_mm = 0.0);

}  // namespace palpate::device
