// Trajectories for any mesh: motions of a hand, a robot or a broken device on a surface that was never tuned for.
#pragma once

#include <cstdint>

#include "lab/judges/surface_side.h"
#include "palpate/device/trajectory.h"

namespace palpate::lab {

struct PathSettings {
  std::size_t ticks = 20000;   ///< each 1 ms
  double step_mm = 0.3;        ///< a tick; 0.3 mm are 300 mm/s
  double depth_mm = 5.0;       ///< below the skin
  double start_above_mm = 10;  ///< height of the first tip over the skin: out of a sphere finger's reach
  double off_border_mm = 0;    ///< targets keep this far from a border; seen from +z on a height field
  double noise_mm = 0.0;       ///< standard deviation of sensor noise
  std::uint64_t seed = 1;
};

/// Rubs: a random walk on the surface whose tip is pushed below it, the depth swinging between a third and all of
/// `depth_mm`, and which lifts off by `depth_mm` about once a second.
device::Trajectory rub(SurfaceSide& surface, const PathSettings& settings);

/// Tours: straight lines at a constant speed between points up to `depth_mm` above and below random surface points,
/// mostly to near ones: it enters and leaves at any angle and also crosses bodies.
device::Trajectory tour(SurfaceSide& surface, const PathSettings& settings);

/// Threes of ticks: `depth_mm` above a vertex or a point of an edge, exactly on it, and as far below, along the normal.
/// Each three is an experiment of its own and wants a fresh finger. Targets near a border are left out.
device::Trajectory aimed(SurfaceSide& surface, const PathSettings& settings);

}  // namespace palpate::lab
