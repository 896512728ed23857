// Runs one finger along one trajectory and measures it: the numbers of `palpate study bench contact` and of the contact
// bars.
//
// mesh file -> scaled -> repaired -> ContactWorld -> runFinger (timed, nothing else in the loop) -> computeFigures (in
// mm and N, whatever the scale was). The outputs stay available, so that a tick can be looked at.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "lab/counters/statistics.h"
#include "lab/counters/thread_counts.h"
#include "lab/judges/fall_check.h"
#include "lab/judges/surface_side.h"
#include "palpate/contact/finger.h"
#include "palpate/contact/surface.h"
#include "palpate/device/trajectory.h"
#include "palpate/hdb/hdb_candidates.h"

namespace palpate::bench {

/// A surface ready for a finger, in a world in which 1 mm is `scale` units long.
struct ContactWorld {
  double scale = 1.0;
  double stiffness_n_per_mm = 0.5;  ///< real, the same everywhere
  std::size_t triangles = 0;        ///< mesh before repair
  contact::Surface surface;
  lab::SurfaceSide side;  ///< the oracle's view of the same (repaired) mesh
};

/// Scales and repairs. Throws Error when the mesh cannot be felt or a number is not positive.
ContactWorld buildContactWorld(mesh::TriangleMesh mesh_mm, double scale = 1.0, double stiffness_n_per_mm = 0.5);

/// The repaired mesh that a contact surface was built from, in the surface's units, its triangles in their own order.
mesh::TriangleMesh extractMesh(const contact::Surface& surface);

/// Result of a run, in the world's units (N for forces).
struct FingerRun {
  std::vector<contact::FingerOutput> outputs;  ///< one a tick
  std::vector<double> tick_us;                 ///< time of each step, the clock's own cost taken off
  lab::ThreadCounts counts;                    ///< during all steps together
};

/// A new finger along the tips, back to back.
FingerRun runFinger(const contact::Surface& surface, const contact::FingerSettings& settings,
                    std::span<const Vec3> tips);

/// Ticks from `from_s` on, before `until_s`, by the trajectory's clock.
struct Window {
  double from_s = -std::numeric_limits<double>::infinity();
  double until_s = std::numeric_limits<double>::infinity();
};

struct FrictionFigures {
  double kinetic = 0.0;  ///< mean of Ft / Fn over slipping ticks
  double kinetic_min = 0.0, kinetic_max = 0.0;
  double static_peak = 0.0;  ///< largest Ft / Fn over sticking ticks
  std::size_t slip_ticks = 0, stick_ticks = 0;
};

struct ContactFigures {
  std::size_t triangles = 0, ticks = 0, contact_ticks = 0;
  lab::Percentiles tick_us;
  lab::Percentiles lag_mm;  ///< |A - D| over ticks in contact, A where friction holds
  lab::FallReport falls;    ///< over the whole run, whatever the window
  std::optional<lab::SphereReport> sphere;
  FrictionFigures friction;
  double peak_force_n = 0.0;
  double max_force_step_n = 0.0;  ///< largest |F(k) - F(k-1)|
  std::size_t max_force_step_tick = 0;
  double peak_depth_mm = 0.0;
  std::size_t teleports = 0;  ///< ticks left out of friction and force figures: |dD| > 5 mm
  lab::ThreadCounts counts;   ///< over the whole run, whatever the window
  std::uint64_t hash = 0;     ///< hash of every bit of every output
};

/// Runs and measures. `real` holds real lengths; the trajectory is in mm and is resampled to the finger's tick. Each
/// tick has its least time over the rounds, all else is the last round's: the work is the same in each, interruptions
/// are not.
ContactFigures measureContact(ContactWorld& world, const device::Trajectory& trajectory,
                              const contact::FingerSettings& real, const Window& window = {}, int rounds = 1);

/// The figures of a run that was made already.
ContactFigures computeFigures(ContactWorld& world, const FingerRun& run, const contact::FingerSettings& real,
                              std::span<const double> time_s, const Window& window = {});

/// The tips in the world's units.
std::vector<Vec3> scaledTips(const device::Trajectory& ticks, double scale);

/// For a finger of the HDB source along a benchmark path, to be compared with the default source.
struct HdbRunSettings {
  hdb::BuildSettings build;
  double edge_mm = 0.0;  ///< edge of the box; 0: a quarter of the longest edge
  hdb::HdbSettings hdb;  ///< its edges are set from edge_mm
};

struct HdbFigures {
  ContactFigures contact;
  std::size_t leaves = 0;
  std::size_t most_listed = 0;  ///< triangles in the box's list
  std::uint64_t queries = 0;    ///< number of queries to the partition
  double edge_mm = 0.0;
};

/// In a world of scale 1. Throws Error for settings that do not go together.
HdbFigures measureHdb(ContactWorld& world, const device::Trajectory& trajectory, const contact::FingerSettings& finger,
                      const HdbRunSettings& settings, const Window& window = {});

}  // namespace palpate::bench
