// One haptic detecting box asked of a partition and judged by brute force: the numbers of `palpate partition --box`.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "lab/counters/statistics.h"
#include "palpate/hdb/haptic_box.h"
#include "palpate/hdb/literal_traversal.h"

namespace palpate::app {

/// How leaves are found: as the engine does, by the sphere within the box (tested properly), or as printed.
struct LeafSearch {
  bool sphere = false;
  std::optional<hdb::LiteralTraversal> literal;

  friend bool operator==(const LeafSearch&, const LeafSearch&) = default;

  bool bySphere() const { return sphere || literal == hdb::LiteralTraversal::SphereCorners; }
};

struct PartitionQuery {
  hdb::LeafHits leaves;
  std::size_t rendered = 0;            ///< entries of the leaves: what the dissertation's haptic process draws
  std::size_t rendered_triangles = 0;  ///< different ones
  std::vector<Index> exact;            ///< triangles whose box meets the detecting box, ascending
  std::size_t must = 0;                ///< how many brute force says the leaves must have
  std::size_t missed = 0;              ///< of these, not in any leaf found
  lab::Percentiles leaves_us;
  lab::Percentiles exact_us;
};

/// With a sphere `must` counts the triangles whose box reaches into it.
PartitionQuery askPartition(const mesh::TriangleMesh& mesh, const hdb::Partition& partition, const Box3& box,
                            const LeafSearch& search);

}  // namespace palpate::app
