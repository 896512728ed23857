// Builds a partition: grow the tree, divide its leaves into blocks, then give every entry and node its box.
//
// Data flow: mesh + BuildSettings (scene) -> here, at load time or on the background builder -> Partition ->
// haptic_box.h. Based on: Ji, dissertation 2008, chapter 3; the tight boxes are E5's correction.
#include <algorithm>
#include <string>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/hdb/detail/growth.h"

namespace palpate::hdb {

namespace {

void check(const mesh::TriangleMesh& mesh, const BuildSettings& settings) {
  if (settings.threshold == 0) throw Error("partition: the threshold must be at least 1");
  if (mesh.triangles.size() >= kNoIndex) throw Error("partition: too many triangles");
  const auto fail = [](std::size_t triangle, const char* cause) {
    throw Error("partition: triangle " + std::to_string(triangle) + " " + cause);
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const Index vertex : mesh.triangles[t]) {
      if (vertex >= mesh.positions.size()) fail(t, "uses a vertex that does not exist");
      if (!mesh::isUsable(mesh.positions[vertex])) fail(t, "has a coordinate that is not finite or absurdly large");
    }
  }
}

Box3 triangleBox(const mesh::TriangleMesh& mesh, Index triangle) {
  const auto [a, b, c] = mesh.triangles[triangle];
  const Vec3 &p = mesh.positions[a], &q = mesh.positions[b], &r = mesh.positions[c];
  return {p.cwiseMin(q).cwiseMin(r), p.cwiseMax(q).cwiseMax(r)};
}

/// Bounds of the triangles, without unused vertices.
Box3 triangleBounds(const mesh::TriangleMesh& mesh) {
  Box3 bounds;
  for (Index t = 0; t < mesh.triangles.size(); ++t) bounds.extend(triangleBox(mesh, t));
  return bounds;
}

void growTree(Growth& growth, const mesh::TriangleMesh& mesh, Assignment assignment) {
  switch (assignment) {
    case Assignment::Cut:
      return growWithCuts(growth, mesh);
    case Assignment::BothSides:
      return growWithBothSides(growth, mesh);
    case Assignment::Majority:
      return growByMajority(growth, mesh);
  }
}

void fillEntries(Partition& partition, Growth& growth, const mesh::TriangleMesh& mesh) {
  constexpr std::size_t kChunk = 1 << 16;  // between two reports
  const std::vector<Item>& items = growth.items;
  partition.triangles.reserve(items.size());
  partition.boxes.reserve(items.size());
  for (std::size_t begin = 0; begin < items.size(); begin += kChunk) {
    const std::size_t end = std::min(begin + kChunk, items.size());
    for (std::size_t i = begin; i < end; ++i) {
      partition.triangles.push_back(items[i].triangle);
      partition.boxes.push_back(triangleBox(mesh, items[i].triangle));
    }
    growth.work_done.add(kEntriesShare * static_cast<double>(end - begin) / static_cast<double>(items.size()));
  }
  if (partition.assignment != Assignment::Cut) return;
  partition.pieces.reserve(items.size());
  for (const Item& item : items) partition.pieces.push_back(growth.pieces[item.piece]);
}

/// Children lie behind their parents, so one round from the back has each node's children ready. Inner nodes get their
/// range of entries on the way.
void fitNodes(Partition& partition) {
  for (std::size_t n = partition.nodes.size(); n-- > 0;) {
    Node& node = partition.nodes[n];
    if (node.child_count == 0) {
      for (Index e = 0; e < node.entry_count; ++e) node.tight.extend(partition.boxes[node.first_entry + e]);
      continue;
    }
    const std::span<const Node> children(partition.nodes.data() + node.first_child, node.child_count);
    for (const Node& child : children) node.tight.extend(child.tight);
    node.first_entry = children.front().first_entry;
    node.entry_count = children.back().first_entry + children.back().entry_count - node.first_entry;
  }
}

}  // namespace

Growth startGrowth(const mesh::TriangleMesh& mesh, const BuildSettings& settings, const Progress& progress) {
  check(mesh, settings);
  Growth growth;
  growth.tree = settings.tree;
  growth.most_in_leaf = settings.leaf_below_threshold ? settings.threshold - 1 : settings.threshold;  // E7
  growth.work_done = WorkDone(progress);
  growth.nodes.emplace_back();
  growth.cells.push_back(triangleBounds(mesh));
  return growth;
}

Partition finishPartition(Growth&& growth, const mesh::TriangleMesh& mesh, Assignment assignment) {
  Partition partition;
  partition.tree = growth.tree;
  partition.assignment = assignment;
  partition.triangle_count = mesh.triangles.size();
  partition.bounds = growth.cells[0];
  if (growth.leaves.empty()) return partition;
  partition.tree_node_count = static_cast<Index>(growth.nodes.size());
  addBlocks(growth);
  fillEntries(partition, growth, mesh);
  partition.nodes = std::move(growth.nodes);
  partition.cells = std::move(growth.cells);
  partition.leaves = std::move(growth.leaves);
  fitNodes(partition);
  return partition;
}

Partition buildPartition(const mesh::TriangleMesh& mesh, const BuildSettings& settings, const Progress& progress) {
  Growth growth = startGrowth(mesh, settings, progress);
  if (!mesh.triangles.empty()) growTree(growth, mesh, settings.assignment);
  return finishPartition(std::move(growth), mesh, settings.assignment);
}

}  // namespace palpate::hdb
