// What the two ways of growing a tree have in common: the tree under construction, and how a node becomes a leaf or
// gets its children. Inside the room only.
#pragma once

#include <cstddef>
#include <vector>

#include "palpate/partition/partition.h"

namespace palpate::partition {

/// An entry while the tree grows.
struct Item {
  Vec3 point;      ///< what stands for it: case C decides by it, blocks are made by it
  Index triangle;  ///< of the mesh
  Index piece;     ///< with the cut: which of Growth::pieces
};

/// The tree under construction: nodes and cells as in Partition, entries as items.
struct Growth {
  TreeKind tree = TreeKind::Octree;
  Index most_in_leaf = 1;
  std::vector<Node> nodes;
  std::vector<Box3> cells;
  std::vector<Index> leaves;
  std::vector<Item> items;
  std::vector<Piece> pieces;

  Progress progress;
  double done = 0.0;      ///< share of the mesh that has reached its leaves
  double reported = 0.0;  ///< the last share that `progress` heard
};

inline int mostLevels(TreeKind tree) { return tree == TreeKind::Bsp ? kMostBspLevels : kMostOctreeLevels; }

/// The root: node 0, all of the space.
void plantRoot(Growth& growth, const Box3& bounds);

/// The cell of the child in this slot.
Box3 childCell(TreeKind tree, const Box3& cell, int level, int slot);

/// Adds the children in these slots behind the last node and links them. Returns the first.
Index addChildren(Growth& growth, Index node, const std::vector<std::uint8_t>& slots);

/// `share` is the part of the mesh that the node holds, for the progress.
void makeLeaf(Growth& growth, Index node, std::size_t first_entry, std::size_t entry_count, double share);

/// Case C: items are divided in place.
void growByMajority(Growth& growth, const mesh::TriangleMesh& mesh);
/// Case B, and case A: a crossed triangle goes on in several children.
void growWithBothSides(Growth& growth, const mesh::TriangleMesh& mesh);
void growWithCuts(Growth& growth, const mesh::TriangleMesh& mesh);

/// Divides the items of each leaf into blocks of a few neighbours, as further nodes.
void addBlocks(Growth& growth);

}  // namespace palpate::partition
