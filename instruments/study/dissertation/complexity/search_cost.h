// Nodes that the search for the leaves around the proxy really visits, counted one by one, against the closed forms of
// (3.1) to (3.9).
//
// The dissertation's cost c counts the nodes on the ways to the leaves found. A program does more: it tests the box of
// every child of a node that it enters. Both are counted here, on complete trees, where the closed forms must hold
// exactly, and on the trees of real models.
// Based on: Ji (2008), 3.3.4 and 3.4.2.
#pragma once

#include <vector>

#include "palpate/hdb/haptic_box.h"

namespace palpate::study {

/// Children of a node: 2 or 8.
int treeArity(hdb::TreeKind tree);

/// One query, or the worst or mean of many.
struct SearchCount {
  double leaves_found = 0.0;  ///< m
  double on_paths = 0.0;      ///< nodes with a found leaf below them: the c of the text
  double entered = 0.0;       ///< and those that were entered in vain
  double tested = 0.0;        ///< boxes tested by a program
};

/// Small triangles, one in the middle of each cell of a regular division of a cube into arity^height cells, so that the
/// tree over them with a threshold of 1 is complete.
mesh::TriangleMesh completeTreeMesh(hdb::TreeKind tree, int height);

/// Counts one search.
class SearchCounter {
 public:
  /// The partition must outlive the counter.
  explicit SearchCounter(const hdb::Partition& partition);

  SearchCount count(const Box3& box);

 private:
  const hdb::Partition& partition_;
  std::vector<Index> parents_;
  std::vector<std::uint32_t> stamp_of_node_;
  std::uint32_t stamp_ = 0;
  hdb::LeafHits hits_;
};

/// Many searches over one tree with a detecting box of one size.
struct SearchSweep {
  int height = 0;
  double leaves = 0.0;  ///< n
  double nodes = 0.0;   ///< nodes of the whole tree
  SearchCount mean;
  SearchCount worst;                 ///< each number by itself
  double worst_over_bound = 0.0;     ///< largest on_paths over mostNodesOnPaths; at most 1
  std::vector<SearchCount> queries;  ///< all of them
};

/// Searches around up to `most_places` vertices of the mesh, evenly chosen; the box is a cube.
SearchSweep sweepSearches(const mesh::TriangleMesh& mesh, const hdb::Partition& tree, double edge_mm,
                          std::size_t most_places);

}  // namespace palpate::study
