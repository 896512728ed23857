// The dissertation's figures for the cost of finding leaves in a complete tree: formulae (3.1) to (3.9) and Tables 3.3
// and 3.4. Closed forms; `arity` is 2 for the BSP tree and 8 for the octree, n is the number of leaves.
#pragma once

#include <cstdint>

#include "palpate/base/elementary.h"

namespace palpate::study {

inline constexpr int kBspArity = 2;
inline constexpr int kOctreeArity = 8;

/// h = log_arity(n). (3.1), (3.6)
inline double heightOfCompleteTree(int arity, double leaves) {
  return elementary::log(leaves) / elementary::log(arity);
}

/// arity^height; exact up to 2^63.
inline std::uint64_t leavesOfCompleteTree(int arity, int height) {
  std::uint64_t leaves = 1;
  for (int level = 0; level < height; ++level) leaves *= static_cast<std::uint64_t>(arity);
  return leaves;
}

/// (arity^(h + 1) - 1) / (arity - 1) = (arity n - 1) / (arity - 1). (3.2), (3.7)
inline double nodesOfCompleteTree(int arity, double leaves) { return (arity * leaves - 1.0) / (arity - 1.0); }

/// The search that ends in a single leaf of a complete tree: a column of Table 3.3 (BSP) or 3.4 (octree).
struct WorstSearch {
  int height = 0;
  double leaves = 0.0;       ///< n
  double nodes = 0.0;        ///< nodes of the whole tree
  double visited = 0.0;      ///< the nodes of one path
  double leaf_ratio = 0.0;   ///< r = 1 / n
  double visit_ratio = 0.0;  ///< r_Bin, r_Oct: visited over nodes. (3.3), (3.8)
  double w = 0.0;            ///< visit_ratio / leaf_ratio
};

inline WorstSearch worstSearch(int arity, int height) {
  WorstSearch search;
  search.height = height;
  search.leaves = static_cast<double>(leavesOfCompleteTree(arity, height));
  search.nodes = nodesOfCompleteTree(arity, search.leaves);
  search.visited = height + 1.0;
  search.leaf_ratio = 1.0 / search.leaves;
  search.visit_ratio = search.visited / search.nodes;
  search.w = search.visit_ratio / search.leaf_ratio;
  return search;
}

/// The heights of Tables 3.3 and 3.4, and the printed w (heights 5 and 9 are misprints, E13).
inline constexpr int kTable33Heights[] = {3, 4, 5, 6, 7, 8, 9, 10};
inline constexpr double kTable33PrintedW[] = {2.13, 2.58, 3.04, 3.53, 4.02, 4.51, 5.01, 5.50};
inline constexpr int kTable34Heights[] = {2, 3, 4};
inline constexpr double kTable34PrintedW[] = {2.63, 3.50, 4.38};

/// The share of leaves that meet the HDB at worst, and the trees that 3.3.4 and 3.4.2 take for their estimates.
inline constexpr double kWorstLeafRatio = 0.1;
inline constexpr int kBspWorstHeight = 7;
inline constexpr int kOctreeWorstHeight = 3;

/// c / n for many leaves: 0.804 for the BSP tree with w = 4.02, 0.400 for the octree with w = 3.50. (3.5), (3.9)
inline double visitedPerLeaf(int arity, double leaf_ratio, double w) { return leaf_ratio * w * arity / (arity - 1.0); }

/// The exact value that r w nodes(n) estimates: the most nodes on the paths to any `found` leaves of a complete tree.
/// Level l has at most arity^l nodes and at most `found` of them lie on a path.
inline std::uint64_t mostNodesOnPaths(int arity, int height, std::uint64_t found) {
  std::uint64_t nodes = 0;
  std::uint64_t on_level = 1;
  for (int level = 0; level <= height; ++level) {
    nodes += on_level < found ? on_level : found;
    on_level *= static_cast<std::uint64_t>(arity);
  }
  return nodes;
}

/// The same when every child of a visited node must be tested: children of the nodes above the leaves, and the root.
inline std::uint64_t mostNodesTested(int arity, int height, std::uint64_t found) {
  const std::uint64_t above_leaves = height > 0 ? mostNodesOnPaths(arity, height - 1, found) : 0;
  return 1 + static_cast<std::uint64_t>(arity) * above_leaves;
}

}  // namespace palpate::study
