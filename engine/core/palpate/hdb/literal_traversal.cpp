// The traversals as printed: by the sides of planes, by the boxes of cells, by the corners of cells.
//
// Data flow: Partition + detecting box -> here, in the tick -> leaves, some of them missing or too many.
// Based on: Ji, dissertation 2008, 3.3.3 and 3.4.1 to the letter (E4, E5, E10, E11).
#include "palpate/hdb/literal_traversal.h"

namespace palpate::hdb {

namespace {

/// Sides of a plane with corners of the box (E9: on the plane is positive). (3.1) of 3.3.3 with axis-aligned planes:
/// the sign of S is the sign of a difference of coordinates.
struct Sides {
  bool negative;
  bool positive;
};

Sides touchedSides(const Box3& box, int axis, double plane) {
  return {box.min()[axis] < plane, box.max()[axis] >= plane};
}

class PlaneTraversal {
 public:
  PlaneTraversal(const Partition& partition, const Box3& box, bool else_if, LeafHits& hits)
      : partition_(partition), box_(box), else_if_(else_if), hits_(hits) {}

  void enter(Index node_index) {
    const Node& node = partition_.nodes[node_index];
    ++hits_.cost.nodes_entered;
    if (node.is_leaf) {
      hits_.leaves.push_back(node_index);
      return;
    }
    const int axis = splitAxis(node.level);
    Sides sides = touchedSides(box_, axis, splitPoint(partition_.cells[node_index])[axis]);
    ++hits_.cost.nodes_tested;
    if (else_if_ && sides.positive) sides.negative = false;  // E4
    if (sides.negative) enterChild(node, 0);
    if (sides.positive) enterChild(node, 1);
  }

 private:
  void enterChild(const Node& node, std::uint8_t slot) {
    for (Index c = node.first_child; c < node.first_child + node.child_count; ++c) {
      if (partition_.nodes[c].slot == slot) enter(c);
    }
  }

  const Partition& partition_;
  const Box3& box_;
  bool else_if_;
  LeafHits& hits_;
};

void enterCells(const Partition& partition, Index node_index, const Box3& box, LeafHits& hits) {
  const Node& node = partition.nodes[node_index];
  ++hits.cost.nodes_tested;
  const Box3& cell = partition.cells[node_index];
  const bool apart = (cell.min().array() > box.max().array()).any() || (box.min().array() > cell.max().array()).any();
  if (apart) return;
  ++hits.cost.nodes_entered;
  if (node.is_leaf) {
    hits.leaves.push_back(node_index);
    return;
  }
  for (Index c = node.first_child; c < node.first_child + node.child_count; ++c) {
    enterCells(partition, c, box, hits);
  }
}

bool hasCornerInside(const Box3& cell, const Vec3& centre, double radius) {
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner = cell.corner(static_cast<Box3::CornerType>(i));
    if ((corner - centre).squaredNorm() <= radius * radius) return true;
  }
  return false;
}

/// All leaves are tested: an inner node whose corners are outside may well have a leaf with one inside.
void testCorners(const Partition& partition, const Box3& box, LeafHits& hits) {
  const double radius = 0.5 * box.sizes().x();
  for (const Index leaf : partition.leaves) {
    ++hits.cost.nodes_tested;
    if (!hasCornerInside(partition.cells[leaf], box.center(), radius)) continue;
    ++hits.cost.nodes_entered;
    hits.leaves.push_back(leaf);
  }
}

}  // namespace

bool suits(LiteralTraversal traversal, TreeKind tree) {
  const bool by_planes = traversal == LiteralTraversal::ElseIf || traversal == LiteralTraversal::HalfSpace;
  return !by_planes || tree == TreeKind::Bsp;
}

std::optional<LiteralTraversal> literalTraversal(const Fidelity& fidelity, TreeKind tree) {
  if (tree == TreeKind::Bsp) {
    if (fidelity.literal(Erratum::E4_else_if)) return LiteralTraversal::ElseIf;
    if (fidelity.literal(Erratum::E10_half_spaces)) return LiteralTraversal::HalfSpace;
    if (fidelity.literal(Erratum::E5_cell_box)) return LiteralTraversal::CellBox;
    return std::nullopt;
  }
  if (fidelity.literal(Erratum::E5_cell_box)) return LiteralTraversal::CellBox;
  if (fidelity.literal(Erratum::E11_sphere_corners)) return LiteralTraversal::SphereCorners;
  return std::nullopt;
}

void findLeavesLiterally(const Partition& partition, LiteralTraversal traversal, const Box3& box,
                         LeafHits& hits) noexcept {
  hits.leaves.clear();
  hits.cost = {};
  if (partition.nodes.empty() || !suits(traversal, partition.tree)) return;
  switch (traversal) {
    case LiteralTraversal::ElseIf:
      return PlaneTraversal(partition, box, true, hits).enter(0);
    case LiteralTraversal::HalfSpace:
      return PlaneTraversal(partition, box, false, hits).enter(0);
    case LiteralTraversal::CellBox:
      return enterCells(partition, 0, box, hits);
    case LiteralTraversal::SphereCorners:
      return testCorners(partition, box, hits);
  }
}

}  // namespace palpate::hdb
