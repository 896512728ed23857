// Times the deformation of the benchmark's back under fingers that wander: the numbers of `palpate study bench deform`.
//
// The literal deformation of the dissertation (literal/deformation.h) is timed on the same mesh and the same places in
// the same run, so that a ratio is always between neighbours in time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "lab/counters/statistics.h"
#include "palpate/deform/contact.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::bench {

struct DeformRun {
  std::size_t triangles = 1000000;              ///< triangles of the back
  std::optional<mesh::TriangleMesh> body = {};  ///< in its place, mm; the fingers wander around `at` on it
  std::optional<Vec3> at = {};                  ///< left out: the highest place (z)
  int fingers = 1;                              ///< side by side, 40 mm apart
  double half_major_mm = 60.0;                  ///< normal and tangential region's
  double aspect = 0.8;                          ///< minor/major
  double depth_mm = 8.0;
  double drag_mm = 0.0;      ///< along x, on a body along the skin that way; 0 presses only
  bool recompute = false;    ///< recomputed instead of analytic normals
  bool incremental = false;  ///< incremental normals (displaced the general way)
  bool strain = false;
  bool principal = false;  ///< principal strain (likewise)
  bool general = false;    ///< displace the general way even where the fast one would do
  bool layered = false;    ///< in tissue 40 mm over the bone, whose layers have regions of their own
  bool literal = true;     ///< also time the dissertation's: some 500 bytes of memory a vertex
  double seconds = 1.0;    ///< time for repetitions
};

/// A finger at a place of a triangle, pressed and dragged by the run's settings.
deform::Contact contactAt(const mesh::TriangleMesh& mesh, Index triangle, const Vec3& place, const DeformRun& run);

/// Where a finger wanders: a few millimetres apart on a circle of 10 mm, as between two frames of a moving hand.
inline constexpr int kPlaces = 16;
std::array<Vec2, kPlaces> placesAround(const Vec2& middle);

/// Cost of an apply in one implementation: whole, from the contacts to the surface with its normals.
struct ApplyFigures {
  double vertices = 0.0;       ///< moved by one apply, mean over the places of the fingers
  double ns_per_vertex = 0.0;  ///< per moved vertex, best round
  double us_per_frame = 0.0;   ///< in the best round
  lab::Percentiles apply_us;   ///< over all rounds
  std::uint64_t hash = 0;      ///< hash of the positions and normals at the first place
};

struct DeformFigures {
  std::size_t triangles = 0;
  ApplyFigures ours;                  ///< search, displacement, normals, restore
  double region_ns_per_vertex = 0.0;  ///< the search for the regions alone
  /// In-place read and write of 24 bytes (position and normal as floats) a vertex, as many vertices, the same moment.
  double copy_floor_ns_per_vertex = 0.0;
  double ratio_to_copy_floor = 0.0;
  std::optional<std::uint64_t> allocations;  ///< during all applies
  std::optional<ApplyFigures> literal;
  std::optional<double> speedup_over_literal;  ///< ratio of the two ns_per_vertex
};

/// The mesh is sorted spatially first. A round visits kPlaces around the middle of the back (the literal one four of
/// them); the shortest time of each place counts, because other load only ever adds. Throws Error for a count the mesh
/// cannot have.
DeformFigures measureDeform(const DeformRun& run);

}  // namespace palpate::bench
