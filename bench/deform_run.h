// Times the deformation of the benchmark's back under a finger that wanders: the numbers of `palpate bench deform`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

namespace palpate::bench {

struct DeformRun {
  std::size_t triangles = 1000000;  ///< of the back
  double half_major_mm = 60.0;      ///< of the normal and the tangential region
  double aspect = 0.8;              ///< minor/major
  double depth_mm = 8.0;
  double drag_mm = 0.0;      ///< along x; 0 presses only
  bool recompute = false;    ///< recomputed instead of analytic normals
  bool incremental = false;  ///< incremental normals (of the general deformer)
  bool strain = false;
  bool principal = false;  ///< principal strain (of the general deformer)
  bool general = false;    ///< the general deformer even where the fast one would do
  double seconds = 1.0;    ///< how long to repeat
};

struct DeformFigures {
  std::size_t triangles = 0;
  double vertices = 0.0;       ///< moved by one apply, mean over the places of the finger
  double ns_per_vertex = 0.0;  ///< whole apply (search, displacement, normals, restore) per moved vertex, best round
  double region_ns_per_vertex = 0.0;  ///< the search for the region alone
  /// In-place read and write of 24 bytes (position and normal as floats) a vertex, as many vertices, the same moment.
  double copy_floor_ns_per_vertex = 0.0;
  double ratio_to_copy_floor = 0.0;
  std::optional<std::uint64_t> allocations;  ///< during all applies
};

/// The mesh is sorted spatially first. A round visits 16 places around the middle of the back; the shortest time of
/// each place counts, because other load only ever adds. Throws Error for a count the mesh cannot have.
DeformFigures measureDeform(const DeformRun& run);

}  // namespace palpate::bench
