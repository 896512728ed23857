// A partition in numbers: height, nodes, leaves, how full they are, how much they overlap, memory.
#pragma once

#include <cstddef>
#include <vector>

#include "palpate/hdb/partition.h"

namespace palpate::bench {

/// Leaves with first to last entries (both included).
struct LeafSizeBin {
  Index first = 0;
  Index last = 0;
  std::size_t leaves = 0;
};

struct LeafSizes {
  Index least = 0;
  double mean = 0.0;
  Index most = 0;
  std::vector<LeafSizeBin> histogram;  ///< 0, 1, 2-3, 4-7, 8-15 ... up to `most`
};

struct PartitionStatistics {
  int height = 0;         ///< level of the deepest leaf, the root is 0
  std::size_t nodes = 0;  ///< in the tree, leaves included, empty ones not
  std::size_t leaves = 0;
  std::size_t empty_nodes = 0;  ///< sides or octants without a triangle, which were dropped
  std::size_t blocks = 0;       ///< nodes below the leaves
  std::size_t entries = 0;
  LeafSizes leaf_sizes;
  double entries_per_triangle = 0.0;  ///< copies of a triangle: 1 with case C, more with A and B
  double leaves_per_point = 0.0;      ///< overlap of leaves: the mean number of leaf boxes around the middle of an
                                  ///< entry; 1 when no two overlap there. At most kOverlapSamples entries are sampled
  std::size_t bytes = 0;  ///< size of the partition's arrays
};

inline constexpr std::size_t kOverlapSamples = 20000;

/// Cold: some milliseconds.
PartitionStatistics statisticsOf(const hdb::Partition& partition);

}  // namespace palpate::bench
