// One haptic detecting box asked of a partition and judged by brute force: the numbers of `palpate partition --box`.
#pragma once

#include <optional>
#include <vector>

#include "bench/statistics.h"
#include "palpate/partition/haptic_box.h"
#include "palpate/partition/literal_traversal.h"

namespace palpate::app {

/// How leaves are found: as the engine does, by the sphere within the box (tested properly), or as printed.
struct LeafSearch {
  bool sphere = false;
  std::optional<partition::LiteralTraversal> literal;

  friend bool operator==(const LeafSearch&, const LeafSearch&) = default;

  bool bySphere() const { return sphere || literal == partition::LiteralTraversal::SphereCorners; }
};

struct PartitionQuery {
  partition::LeafHits leaves;
  std::size_t rendered = 0;            ///< entries of the leaves: what the dissertation's haptic process draws
  std::size_t rendered_triangles = 0;  ///< different ones
  std::vector<Index> exact;            ///< triangles whose box meets the detecting box, ascending
  std::size_t must = 0;                ///< how many brute force says the leaves must have
  std::size_t missed = 0;              ///< of these, not in any leaf found
  bench::Percentiles leaves_us;
  bench::Percentiles exact_us;
};

/// With a sphere `must` counts the triangles whose box reaches into it.
PartitionQuery askPartition(const mesh::TriangleMesh& mesh, const partition::Partition& partition,
                            const partition::Box3& box, const LeafSearch& search);

}  // namespace palpate::app
