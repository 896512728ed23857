// The benchmark trajectories: one tip position a millisecond, computed instead of stored.
//
// Deterministic paths (back_slide, eggcrate_*, flat_edge, flat_fric_*) are those of the benchmark's reference script to
// the last digit of its files (instruments/study/lab/tests/lab checks their SHA-256). Paths with random numbers
// (back_jump*, back_stab*, groove*, pit) have the same distributions but come from base/random.h, so they differ in
// every number. The rest (flat_press, lattice_*) is of this project. Coordinates are rounded to a nanometre, as the
// files hold them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "palpate/device/trajectory.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::lab {

/// The slide of back_slide: pressed 5 to 10 mm deep, 100 to 500 mm/s. The bars on lag and force step hold here.
inline constexpr double kSlideFromSeconds = 2.2;
inline constexpr double kSlideUntilSeconds = 18.0;

/// A named path and the mesh of workload_meshes.h that it was made for (`back` means any back_N).
struct PathName {
  std::string path;
  std::string mesh;
};
std::vector<PathName> workloadPathNames();

/// The path of that name; throws Error for another. Numbers in a name may be any: back_jump7mm, eggcrate_0.3mps.
device::Trajectory workloadPath(std::string_view name);

/// Approach in free space, press, slide along a Lissajous figure for 16 s, lift. 20 s.
device::Trajectory backSlide();
/// A random walk with steps of one length, 2 to 25 mm under the skin of the back. 20 s.
device::Trajectory backJumps(double step_mm, std::uint64_t seed);
/// 300 vertical stabs from 20 mm above to 20 mm below and back, with a jump through the air between them.
device::Trajectory backStabs(double metres_per_second, std::uint64_t seed);
/// Shaking across a groove of any angle, 10 mm below its bottom. 20 s.
device::Trajectory grooveShake(std::uint64_t seed);
/// Shaking around the bottom of the pit, 10 mm below it. 20 s.
device::Trajectory pitShake(std::uint64_t seed);
/// Back and forth through the egg-crate, 3 mm below its middle. 20 s.
device::Trajectory eggcrateSlide(double metres_per_second);
/// Off the plate's border and back below it. Leaves contact after 0.15 s and never lifts: it shows the exit only.
device::Trajectory flatEdge();
/// Press, slide off the border in one of 16 directions (corners too), lift, come back through the air, press again.
device::Trajectory flatPress();
/// Press 5 mm, hold, slide 40 mm straight.
device::Trajectory flatFriction(double mm_per_second);
/// 100 s on the corners of a 1 mm lattice, so that tips lie exactly on the planes, edges and vertices of lattice100.
device::Trajectory latticeFlat(std::uint64_t seed);
/// The same over groove90 on a lattice of 1.25 mm.
device::Trajectory latticeGroove(std::uint64_t seed);

/// Around a body, 5 to 10 mm below the outermost skin seen from `centre`, at up to 0.2 m/s radially. 20 s.
device::Trajectory orbit(const mesh::TriangleMesh& body, const Vec3& centre);

}  // namespace palpate::lab
