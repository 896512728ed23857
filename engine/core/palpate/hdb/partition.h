// The dissertation's partitions of a triangle surface: an axis-aligned BSP tree or an octree whose leaves hold the
// triangles, built once at load and queried for the triangles around the finger (haptic_box.h).
//
// Everything lies in flat arrays. A leaf is a range of *entries*; an entry is a triangle, or with the cut a piece of
// one, that lies in that leaf. Entries are in leaf order, so the entries of any subtree are one range too. Below the
// leaves the same array of nodes continues with small blocks of entries: the exact query descends to them, everything
// that speaks of the dissertation's tree stops at the leaves.
//
// Based on: Ji (2008), chapter 3; Meagher (1982) for the octree; Fuchs, Kedem, Naylor (1980) for the BSP tree.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::hdb {

enum class TreeKind : std::uint8_t {
  Bsp,    ///< halves by x, y, z in turn (3.3.1)
  Octree  ///< eighths (3.4)
};

/// Its name in sentences; files and commands have words for it (scene/words.h).
constexpr const char* titleOf(TreeKind tree) { return tree == TreeKind::Bsp ? "BSP tree" : "octree"; }

/// Treatment of a triangle that a splitting plane crosses (3.3.2).
enum class Assignment : std::uint8_t {
  Cut,        ///< case A: it is cut; each side keeps its pieces
  BothSides,  ///< case B: it goes to every side on which it has a vertex
  Majority    ///< case C: it goes where two of its vertices lie
};

struct BuildSettings {
  TreeKind tree = TreeKind::Octree;
  Assignment assignment = Assignment::Majority;
  Index threshold = 1024;             ///< a node with at most this many entries is a leaf; at least 1
  bool leaf_below_threshold = false;  ///< E7: the text's rule, fewer than the threshold
};

/// A node of the tree, or a block of entries below a leaf. One cache line.
struct Node {
  Box3 tight;  ///< bounds of the whole triangles that have an entry here (E5)
  Index first_entry = 0;
  Index entry_count = 0;
  Index first_child = 0;         ///< children lie side by side and after their parent; no empty ones
  std::uint8_t child_count = 0;  ///< 0: nothing below, not even blocks
  std::uint8_t level = 0;        ///< depth in the tree, the root is 0
  std::uint8_t slot = 0;         ///< BSP: 1 on the positive side; octree: bits x = 1, y = 2, z = 4 set when positive
  bool is_leaf = false;          ///< in the tree: its children are blocks
};
static_assert(sizeof(Node) == 64);

/// A part of a triangle that the planes cut, wound as the triangle.
using Piece = std::array<Vec3, 3>;

/// Immutable once built; any number of threads may ask it.
struct Partition {
  TreeKind tree = TreeKind::Octree;
  Assignment assignment = Assignment::Majority;
  std::vector<Node> nodes;       ///< nodes[0] is the root; empty for a mesh without triangles
  Index tree_node_count = 0;     ///< nodes from here on are blocks
  std::vector<Box3> cells;       ///< space of each node of the tree
  std::vector<Index> leaves;     ///< nodes, in the order of their entries
  std::vector<Index> triangles;  ///< per entry: the mesh's triangle
  std::vector<Box3> boxes;       ///< per entry: the whole triangle's box
  std::vector<Piece> pieces;     ///< per entry; only with Assignment::Cut
  std::size_t triangle_count = 0;
  Box3 bounds;  ///< all triangles', the root's cell

  /// With the cut and with both sides a triangle may have several entries.
  bool mayRepeat() const { return assignment != Assignment::Majority; }
};

/// The triangles of a node's entries; with A and B one may come twice.
inline std::span<const Index> trianglesOf(const Partition& partition, const Node& node) {
  return {partition.triangles.data() + node.first_entry, node.entry_count};
}

/// Where the planes of a node cross (E9: a coordinate equal to it is on the positive side).
inline Vec3 splitPoint(const Box3& cell) { return 0.5 * (cell.min() + cell.max()); }
/// BSP: the axis whose plane divides the nodes of a level (E8: level mod 3).
inline int splitAxis(int level) { return level % 3; }

/// Beyond these depths a node stays a leaf, whatever it holds: cells of 2^-32 of the model separate nothing.
inline constexpr int kMaxOctreeLevels = 32;
inline constexpr int kMaxBspLevels = 3 * kMaxOctreeLevels;
/// With A and B a mesh of n triangles gets at most this many times n entries; where cutting on would need more, leaves
/// stay larger than the threshold. Long slivers that cross every plane would fill any memory otherwise.
inline constexpr double kMaxEntriesPerTriangle = 16.0;

/// Throws Error for a threshold of 0, an index out of range, a coordinate that is not usable, or more entries than
/// Index can count. `progress` may throw to stop the work. About 0.2 us and 70 bytes a triangle with case C.
Partition buildPartition(const mesh::TriangleMesh& mesh, const BuildSettings& settings, const Progress& progress = {});

}  // namespace palpate::hdb
