// Finds the contents of the detecting box: the leaves of the dissertation's tree, and exactly the triangles, by descent
// with the nodes' tight boxes.
//
// Data flow: Partition (load time) + box round the proxy -> here, in the tick -> ranges of entries -> hdb_candidates.
// Based on: Ji, dissertation 2008, 3.3.3 and 3.4.1, as E4, E5 and E11 correct them.
#include "palpate/hdb/haptic_box.h"

#include <algorithm>

#include "palpate/base/aligned.h"

namespace palpate::hdb {

namespace {

constexpr double kHdbShare = 0.25;  // "in 1/4 size of the AABB of the model", 3.3.3

bool holds(const Box3& outer, const Box3& inner) {
  const Vec3 &o_low = outer.min(), &o_high = outer.max(), &i_low = inner.min(), &i_high = inner.max();
  return bool((o_low[0] <= i_low[0]) & (o_low[1] <= i_low[1]) & (o_low[2] <= i_low[2]) & (i_high[0] <= o_high[0]) &
              (i_high[1] <= o_high[1]) & (i_high[2] <= o_high[2]));
}

/// Each child on its own test (E4).
template <class MeetsShape>
void collectLeaves(const Partition& partition, Index node_index, const MeetsShape& meets_shape, LeafHits& hits) {
  const Node& node = partition.nodes[node_index];
  ++hits.cost.nodes_entered;
  if (node.is_leaf) {
    hits.leaves.push_back(node_index);
    return;
  }
  hits.cost.nodes_tested += node.child_count;
  for (Index child = node.first_child; child < node.first_child + node.child_count; ++child) {
    if (meets_shape(partition.nodes[child].tight)) collectLeaves(partition, child, meets_shape, hits);
  }
}

template <class MeetsShape>
void findLeavesIf(const Partition& partition, const MeetsShape& meets_shape, LeafHits& hits) {
  hits.leaves.clear();
  hits.cost = {};
  if (partition.nodes.empty()) return;
  hits.cost.nodes_tested = 1;
  if (meets_shape(partition.nodes[0].tight)) {
    collectLeaves(partition, 0, meets_shape, hits);
  } else {
    hits.cost.nodes_entered = 1;
  }
}

void append(std::vector<EntryRange>& ranges, Index begin, Index end) {
  if (!ranges.empty() && ranges.back().end == begin) {
    ranges.back().end = end;
  } else {
    ranges.push_back({begin, end});
  }
}

/// `node` meets the box.
void collectRanges(const Partition& partition, const Node& node, const Box3& box, std::vector<EntryRange>& ranges) {
  const Index end = node.first_entry + node.entry_count;
  if (holds(box, node.tight)) {
    append(ranges, node.first_entry, end);
    return;
  }
  for (Index child = node.first_child; child < node.first_child + node.child_count; ++child) {
    if (meets(partition.nodes[child].tight, box)) collectRanges(partition, partition.nodes[child], box, ranges);
  }
  if (node.child_count > 0) return;
  for (Index e = node.first_entry; e < end; ++e) {
    if (meets(partition.boxes[e], box)) append(ranges, e, e + 1);
  }
}

void listOnce(const Partition& partition, TriangleHits& hits) {
  if (++hits.stamp == 0) {  // once in four billion queries
    std::fill(hits.stamp_of_triangle.begin(), hits.stamp_of_triangle.end(), 0);
    hits.stamp = 1;
  }
  for (const EntryRange& range : hits.ranges) {
    for (Index e = range.begin; e < range.end; ++e) {
      const Index triangle = partition.triangles[e];
      if (hits.stamp_of_triangle[triangle] == hits.stamp) continue;
      hits.stamp_of_triangle[triangle] = hits.stamp;
      hits.triangles.push_back(triangle);
    }
  }
}

}  // namespace

Vec3 hdbEdges(const Box3& model, HdbSize size) {
  if (model.isEmpty()) return Vec3::Zero();
  const Vec3 edges = kHdbShare * model.sizes();
  return size == HdbSize::QuarterOfBox ? edges : Vec3::Constant(edges.maxCoeff());
}

double leastHdbEdge(double speed, double delay_s, double margin_mm) { return 2.0 * (speed * delay_s + margin_mm); }

void TriangleHits::prepareFor(const Partition& partition) {
  reserveTouched(ranges, partition.triangles.size() / 2 + 1);
  reserveTouched(triangles, partition.triangle_count);
  if (partition.mayRepeat()) stamp_of_triangle.assign(partition.triangle_count, 0);
  stamp = 0;
}

void findLeaves(const Partition& partition, const Box3& box, LeafHits& hits) noexcept {
  findLeavesIf(
      partition, [&](const Box3& tight) { return meets(tight, box); }, hits);
}

void findLeavesInSphere(const Partition& partition, const Vec3& centre, double radius, LeafHits& hits) noexcept {
  findLeavesIf(
      partition, [&](const Box3& tight) { return tight.squaredExteriorDistance(centre) <= radius * radius; }, hits);
}

void findTriangles(const Partition& partition, const Box3& box, TriangleHits& hits) noexcept {
  hits.ranges.clear();
  if (partition.nodes.empty() || !meets(partition.nodes[0].tight, box)) return;
  collectRanges(partition, partition.nodes[0], box, hits.ranges);
}

void listTriangles(const Partition& partition, TriangleHits& hits) noexcept {
  hits.triangles.clear();
  if (partition.mayRepeat()) {
    listOnce(partition, hits);
    return;
  }
  const auto first = partition.triangles.begin();
  for (const EntryRange& range : hits.ranges) {
    hits.triangles.insert(hits.triangles.end(), first + range.begin, first + range.end);
  }
}

std::size_t entriesIn(const Partition& partition, const std::vector<Index>& leaves) noexcept {
  std::size_t entries = 0;
  for (const Index leaf : leaves) entries += partition.nodes[leaf].entry_count;
  return entries;
}

std::size_t entriesIn(const std::vector<EntryRange>& ranges) noexcept {
  std::size_t entries = 0;
  for (const EntryRange& range : ranges) entries += range.size();
  return entries;
}

}  // namespace palpate::hdb
