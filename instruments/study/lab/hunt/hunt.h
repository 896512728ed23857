// The hunt: random bodies, random paths, every radius, checked tick by tick, on any number of threads.
//
// plan -> jobs (a body and a portion of the ticks) -> paths -> hunt_world.h -> HuntResult. The same plan gives the same
// result whatever the number of threads, unless it is limited by time.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lab/hunt/hunt_world.h"
#include "palpate/base/progress.h"

namespace palpate::lab {

/// A body from outside, in mm, unrepaired.
struct NamedBody {
  std::string name;
  mesh::TriangleMesh mesh;
};

struct HuntPlan {
  std::size_t ticks = 1000000;
  std::optional<double> seconds;  ///< this long instead of `ticks`
  std::uint64_t seed = 1;
  std::vector<double> radii_mm{0.0, 0.5, 2.0, 5.0, 8.0};
  std::vector<NamedBody> meshes;
  bool generated = true;           ///< bodies of hunted_bodies.h
  std::vector<std::string> kinds;  ///< their kinds; empty: all
  std::size_t bodies = 0;          ///< generated ones; 0: one for every 20,000 ticks
  double scale = 1.0;              ///< units per millimetre
  std::size_t lumps = 0;           ///< under the skin of each body, felt by two fingers; at scale 1 only
  std::size_t threads = 0;         ///< 0: as many as there are processors
  /// Called before every path, by any thread; true ends the hunt with its results so far. May be empty.
  std::function<bool()> stop;
};

/// A path with a fault. Body, seed and radius make it again.
struct FailingPath {
  std::string body;        ///< "kind#seed" or the name of a mesh
  std::uint64_t seed = 0;  ///< seed of the path
  double radius_mm = 0.0;
  std::size_t ticks = 0;  ///< length of the path
  Fault fault = Fault::fall;
  Finding finding;  ///< lengths and forces in the scaled world
};

struct HuntResult {
  std::size_t ticks = 0, touching_ticks = 0, held_through_ticks = 0, events = 0, paths = 0;
  std::size_t open_ticks = 0;              ///< among `ticks`, on bodies that have a border
  std::size_t held_in_air_open_ticks = 0;  ///< ticks among Fault::held_in_air on such bodies
  std::size_t bodies = 0;
  std::array<std::size_t, kFaults> fault_ticks{};
  std::vector<FailingPath> failing;
  double seconds = 0.0;  ///< wall time
};

/// Throws Error for a plan without bodies, radii or ticks, and naming a body that cannot be felt.
HuntResult hunt(const HuntPlan& plan, const Progress& progress = {});

/// The body of that name in the plan's scale: a mesh of the plan, or a generated "kind#seed". Throws Error.
mesh::TriangleMesh huntedMesh(const HuntPlan& plan, const std::string& name);

/// The path of that seed on a body: 500 to 3,000 ticks, of any kind.
std::vector<Vec3> huntedTips(OracleBody& body, std::uint64_t seed, double radius_mm, double mm);

}  // namespace palpate::lab
