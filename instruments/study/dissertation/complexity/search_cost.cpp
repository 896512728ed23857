// Nodes on the ways are counted upwards from the leaves found, by parents and a stamp a node; the nodes entered and
// boxes tested are the search's own count. A complete tree is grown from one tiny triangle in each of its cells.
// Based on: see search_cost.h.
#include "dissertation/complexity/search_cost.h"

#include <algorithm>
#include <cmath>

#include "dissertation/cost/complexity.h"

namespace palpate::study {

int treeArity(hdb::TreeKind tree) { return tree == hdb::TreeKind::Bsp ? kBspArity : kOctreeArity; }

namespace {

void addTriangle(const Vec3& centre, mesh::TriangleMesh& mesh) {
  constexpr double kSize = 1e-3;  // in cells
  const auto first = static_cast<Index>(mesh.positions.size());
  mesh.positions.push_back(centre);
  mesh.positions.push_back(centre + Vec3(kSize, 0.0, kSize));
  mesh.positions.push_back(centre + Vec3(0.0, kSize, kSize));
  mesh.triangles.push_back({first, first + 1, first + 2});
}

void updateMaxima(const SearchCount& count, SearchCount& most) {
  most.leaves_found = std::max(most.leaves_found, count.leaves_found);
  most.on_paths = std::max(most.on_paths, count.on_paths);
  most.entered = std::max(most.entered, count.entered);
  most.tested = std::max(most.tested, count.tested);
}

void addShare(const SearchCount& count, double share, SearchCount& mean) {
  mean.leaves_found += share * count.leaves_found;
  mean.on_paths += share * count.on_paths;
  mean.entered += share * count.entered;
  mean.tested += share * count.tested;
}

int treeHeight(const hdb::Partition& tree) {
  int height = 0;
  for (const Index leaf : tree.leaves) height = std::max<int>(height, tree.nodes[leaf].level);
  return height;
}

}  // namespace

mesh::TriangleMesh completeTreeMesh(hdb::TreeKind tree, int height) {
  // The BSP tree halves x, y, z in turn, the octree all three at once.
  std::array<int, 3> cells{1, 1, 1};
  const int halvings = tree == hdb::TreeKind::Bsp ? height : 3 * height;
  for (int level = 0; level < halvings; ++level) cells[static_cast<std::size_t>(level % 3)] *= 2;
  // Cells of unequal edges keep the whole a cube; the corners of the model's box must be those of the outer cells.
  const int longest = cells[0];
  mesh::TriangleMesh mesh;
  for (int z = 0; z < cells[2]; ++z) {
    for (int y = 0; y < cells[1]; ++y) {
      for (int x = 0; x < cells[0]; ++x) {
        const Vec3 share((x + 0.5) / cells[0], (y + 0.5) / cells[1], (z + 0.5) / cells[2]);
        addTriangle(longest * share, mesh);
      }
    }
  }
  return mesh;
}

SearchCounter::SearchCounter(const hdb::Partition& partition)
    : partition_(partition),
      parents_(partition.tree_node_count, kNoIndex),
      stamp_of_node_(partition.tree_node_count, 0) {
  for (Index node = 0; node < partition.tree_node_count; ++node) {
    const hdb::Node& parent = partition.nodes[node];
    if (parent.is_leaf) continue;
    for (Index child = 0; child < parent.child_count; ++child) parents_[parent.first_child + child] = node;
  }
  hits_.prepareFor(partition);
}

SearchCount SearchCounter::count(const Box3& box) {
  hdb::findLeaves(partition_, box, hits_);
  ++stamp_;
  SearchCount count{.leaves_found = static_cast<double>(hits_.leaves.size()),
                    .entered = static_cast<double>(hits_.cost.nodes_entered),
                    .tested = static_cast<double>(hits_.cost.nodes_tested)};
  for (Index node : hits_.leaves) {
    for (; node != kNoIndex && stamp_of_node_[node] != stamp_; node = parents_[node]) {
      stamp_of_node_[node] = stamp_;
      count.on_paths += 1.0;
    }
  }
  return count;
}

SearchSweep sweepSearches(const mesh::TriangleMesh& mesh, const hdb::Partition& tree, double edge_mm,
                          std::size_t most_places) {
  SearchSweep sweep;
  sweep.height = treeHeight(tree);
  sweep.leaves = static_cast<double>(tree.leaves.size());
  sweep.nodes = static_cast<double>(tree.tree_node_count);
  SearchCounter counter(tree);
  const std::size_t stride = std::max<std::size_t>(1, mesh.positions.size() / most_places);
  const double share = 1.0 / std::ceil(static_cast<double>(mesh.positions.size()) / static_cast<double>(stride));
  for (std::size_t v = 0; v < mesh.positions.size(); v += stride) {
    const SearchCount count = counter.count(hdb::hapticBox(mesh.positions[v], edge_mm));
    const auto bound =
        mostNodesOnPaths(treeArity(tree.tree), sweep.height, static_cast<std::uint64_t>(count.leaves_found));
    if (bound > 0)
      sweep.worst_over_bound = std::max(sweep.worst_over_bound, count.on_paths / static_cast<double>(bound));
    updateMaxima(count, sweep.worst);
    addShare(count, share, sweep.mean);
    sweep.queries.push_back(count);
  }
  return sweep;
}

}  // namespace palpate::study
