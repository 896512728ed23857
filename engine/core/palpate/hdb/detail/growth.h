// Common part of the two ways of growing a tree: the tree under construction, and how a node becomes a leaf or gets its
// children. Private to the folder.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "palpate/hdb/partition.h"

namespace palpate::hdb {

/// The most entries of a node without children. Fewer cost nodes, more cost box tests.
inline constexpr Index kBlockEntries = 16;

/// An entry while the tree grows.
struct Item {
  Vec3 point;      ///< representative point: case C decides by it, blocks are made by it
  Index triangle;  ///< index in the mesh
  Index piece;     ///< with the cut: which of Growth::pieces
};

/// Adds up the shares of the work that are done and reports them in steps.
class WorkDone {
 public:
  WorkDone() = default;
  explicit WorkDone(Progress progress) : progress_(std::move(progress)) {}
  void add(double share);

 private:
  Progress progress_;
  double done_ = 0.0;
  double reported_ = 0.0;
};

// Shares of a build's time among its stages, about (case C, 4,000,000 triangles).
inline constexpr double kGrowthShare = 0.6;
inline constexpr double kBlocksShare = 0.2;
inline constexpr double kEntriesShare = 0.2;

/// The tree under construction: nodes and cells as in Partition, entries as items.
struct Growth {
  TreeKind tree = TreeKind::Octree;
  Index most_in_leaf = 1;
  std::vector<Node> nodes;
  std::vector<Box3> cells;
  std::vector<Index> leaves;
  std::vector<Item> items;
  std::vector<Piece> pieces;
  WorkDone work_done;
};

/// The middle one of the three x, of the three y, and of the three z: by it case C decides, because it lies on the side
/// of a plane on which two vertices lie.
Vec3 middlePoint(const mesh::TriangleMesh& mesh, Index triangle);

inline int mostLevels(TreeKind tree) { return tree == TreeKind::Bsp ? kMaxBspLevels : kMaxOctreeLevels; }

/// A tree of one node, the whole space, that wants to grow. Throws Error as buildPartition does.
Growth startGrowth(const mesh::TriangleMesh& mesh, const BuildSettings& settings, const Progress& progress);

/// Divides the leaves of the grown tree into blocks and gives every entry and node its box.
Partition finishPartition(Growth&& growth, const mesh::TriangleMesh& mesh, Assignment assignment);

/// The cell of the child in this slot.
Box3 childCell(TreeKind tree, const Box3& cell, int level, int slot);

/// Adds the children in these slots behind the last node and links them. Returns the first.
Index addChildren(Growth& growth, Index node, const std::vector<std::uint8_t>& slots);

/// Divides what a node holds among its children: `halve(whole, axis, at)` gives its two sides, `take(part, slot)` gets
/// each child's.
template <class Whole, class Halve, class Take>
void divideAmongChildren(const Growth& growth, Index node, const Whole& whole, const Halve& halve, const Take& take) {
  const Vec3 at = splitPoint(growth.cells[node]);
  const auto take_both = [&](auto halves, int first_slot) {
    for (int side = 0; side < 2; ++side) take(std::move(halves[side]), first_slot + side);
  };
  if (growth.tree == TreeKind::Bsp) return take_both(halve(whole, splitAxis(growth.nodes[node].level), at), 0);
  const auto by_z = halve(whole, 2, at);
  for (int z = 0; z < 2; ++z) {
    const auto by_y = halve(by_z[z], 1, at);
    for (int y = 0; y < 2; ++y) take_both(halve(by_y[y], 0, at), 2 * y + 4 * z);
  }
}

/// `share` is the part of the mesh that the node holds, for the progress: all leaves together have 1.
void makeLeaf(Growth& growth, Index node, std::size_t first_entry, std::size_t entry_count, double share);

/// Case C: items are divided in place.
void growByMajority(Growth& growth, const mesh::TriangleMesh& mesh);
/// Case B, and case A: a crossed triangle continues in several children.
void growWithBothSides(Growth& growth, const mesh::TriangleMesh& mesh);
void growWithCuts(Growth& growth, const mesh::TriangleMesh& mesh);

/// Divides the items of each leaf into blocks of a few neighbours, as further nodes.
void addBlocks(Growth& growth);

}  // namespace palpate::hdb
