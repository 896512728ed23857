// Counts a partition: one pass over its nodes and entries.
//
// Data flow: Partition -> here -> `palpate study partition` and the studies. Based on: Ji, dissertation 2008, 3.3.1,
// Table 3.3.
#include "lab/runs/partition_statistics.h"

#include <algorithm>
#include <bit>

#include "palpate/hdb/haptic_box.h"

namespace palpate::bench {

namespace {

template <class T>
std::size_t bytesOf(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

std::size_t bytesOf(const hdb::Partition& partition) {
  return bytesOf(partition.nodes) + bytesOf(partition.cells) + bytesOf(partition.leaves) +
         bytesOf(partition.triangles) + bytesOf(partition.boxes) + bytesOf(partition.pieces);
}

std::size_t emptyNodes(const hdb::Partition& partition) {
  const std::size_t arity = partition.tree == hdb::TreeKind::Bsp ? 2 : 8;
  std::size_t empty = 0;
  for (Index n = 0; n < partition.tree_node_count; ++n) {
    if (!partition.nodes[n].is_leaf) empty += arity - partition.nodes[n].child_count;
  }
  return empty;
}

LeafSizes leafSizes(const hdb::Partition& partition) {
  LeafSizes sizes;
  if (partition.leaves.empty()) return sizes;
  sizes.least = kNoIndex;
  for (const Index leaf : partition.leaves) {
    const Index count = partition.nodes[leaf].entry_count;
    sizes.least = std::min(sizes.least, count);
    sizes.most = std::max(sizes.most, count);
    const auto bin = static_cast<std::size_t>(std::bit_width(count));
    for (std::size_t b = sizes.histogram.size(); b <= bin; ++b) {
      const Index first = b == 0 ? 0 : Index{1} << (b - 1);
      sizes.histogram.push_back({first, b == 0 ? 0 : 2 * first - 1, 0});
    }
    ++sizes.histogram[bin].leaves;
  }
  sizes.mean = static_cast<double>(partition.triangles.size()) / static_cast<double>(partition.leaves.size());
  return sizes;
}

/// The box of the leaf's triangles, or of its pieces where triangles are cut.
Box3 drawnBox(const hdb::Partition& partition, const hdb::Node& leaf) {
  if (partition.pieces.empty()) return leaf.tight;
  Box3 box;
  for (Index e = leaf.first_entry; e < leaf.first_entry + leaf.entry_count; ++e) {
    for (const Vec3& corner : partition.pieces[e]) box.extend(corner);
  }
  return box;
}

Vec3 entryCentre(const hdb::Partition& partition, std::size_t entry) {
  if (partition.pieces.empty()) return partition.boxes[entry].center();
  const auto& [a, b, c] = partition.pieces[entry];
  return (a + b + c) / 3.0;
}

std::vector<Box3> drawnBoxes(const hdb::Partition& partition) {
  std::vector<Box3> boxes(partition.tree_node_count);
  for (const Index leaf : partition.leaves) boxes[leaf] = drawnBox(partition, partition.nodes[leaf]);
  return boxes;
}

double leavesPerPoint(const hdb::Partition& partition) {
  const std::size_t entries = partition.triangles.size();
  if (entries == 0) return 0.0;
  const std::vector<Box3> boxes = drawnBoxes(partition);
  const std::size_t samples = std::min(entries, kOverlapSamples);
  hdb::LeafHits hits;
  std::size_t leaves = 0;
  for (std::size_t i = 0; i < samples; ++i) {
    const Vec3 point = entryCentre(partition, i * entries / samples);
    hdb::findLeaves(partition, Box3(point), hits);
    for (const Index leaf : hits.leaves) leaves += boxes[leaf].contains(point) ? 1 : 0;
  }
  return static_cast<double>(leaves) / static_cast<double>(samples);
}

}  // namespace

PartitionStatistics statisticsOf(const hdb::Partition& partition) {
  PartitionStatistics statistics;
  for (const Index leaf : partition.leaves) {
    statistics.height = std::max<int>(statistics.height, partition.nodes[leaf].level);
  }
  statistics.nodes = partition.tree_node_count;
  statistics.leaves = partition.leaves.size();
  statistics.empty_nodes = emptyNodes(partition);
  statistics.blocks = partition.nodes.size() - partition.tree_node_count;
  statistics.entries = partition.triangles.size();
  statistics.leaf_sizes = leafSizes(partition);
  if (partition.triangle_count > 0) {
    statistics.entries_per_triangle =
        static_cast<double>(statistics.entries) / static_cast<double>(partition.triangle_count);
  }
  statistics.leaves_per_point = leavesPerPoint(partition);
  statistics.bytes = bytesOf(partition);
  return statistics;
}

}  // namespace palpate::bench
