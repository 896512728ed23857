// Times the haptic detecting box on a partition: the numbers of `palpate study bench partition`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "lab/counters/statistics.h"
#include "palpate/hdb/coherent_list.h"

namespace palpate::bench {

struct PartitionRun {
  hdb::BuildSettings settings;
  double speed_mm_s = 200.0;  ///< speed of the finger that slides over the surface at 1 kHz
  double margin = hdb::kCoherentMargin;
  int ticks = 5000;
};

struct PartitionFigures {
  std::size_t triangles = 0;
  double edge_mm = 0.0;           ///< edge of the box: a quarter of the model's longest
  lab::Percentiles hdb_query_us;  ///< the exact triangles, found and written out one by one
  lab::Percentiles ranges_us;     ///< found only, as ranges of entries
  lab::Percentiles leaves_us;     ///< the leaves only
  double mean_triangles = 0.0;
  double mean_ranges = 0.0;
  double mean_rendered = 0.0;  ///< entries of the leaves
  double hybrid_us_per_tick = 0.0;
  double hybrid_worst_us = 0.0;
  std::uint64_t hybrid_refreshes = 0;
  double linked_us_per_tick = 0.0;  ///< the hybrid of tree and linked list follows the box
  double linked_worst_us = 0.0;
  double linked_boxes = 0.0;  ///< nodes and triangles that it tests in a tick
  double bytes_per_triangle = 0.0;
  double build_ns_per_triangle = 0.0;
  std::optional<std::uint64_t> allocations;  ///< during all queries
  std::uint64_t hash = 0;                    ///< hash of everything that the queries found
};

/// The finger slides between random vertices of the surface, held to it; every tick queries. Throws Error for a mesh
/// without triangles and as buildPartition does.
PartitionFigures measurePartition(const mesh::TriangleMesh& mesh, const PartitionRun& run);

/// The boxes of a quarter of the longest edge that measurePartition queries, one a tick.
std::vector<Box3> slidingBoxes(const mesh::TriangleMesh& mesh, const PartitionRun& run);

}  // namespace palpate::bench
