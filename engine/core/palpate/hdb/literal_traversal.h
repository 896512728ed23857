// Ways to find the leaves around the proxy as the dissertation prints them, for comparison with haptic_box.h, which
// misses nothing. Each is named after its method; the erratum describes its fault.
#pragma once

#include <cstdint>
#include <optional>

#include "palpate/base/fidelity.h"
#include "palpate/hdb/haptic_box.h"

namespace palpate::hdb {

enum class LiteralTraversal : std::uint8_t {
  ElseIf,     ///< BSP: the pseudocode of 3.3.3; a box across a plane goes into the positive child only (E4)
  HalfSpace,  ///< BSP: both children, but a node is its half-space: far outer leaves, sticking-out triangles (E10, E5)
  CellBox,    ///< the box of the node's space in place of the box of its triangles (E5)
  SphereCorners  ///< a leaf is met when one of the eight corners of its space is within half the edge (E11)
};

/// The half-spaces belong to planes, which only the BSP tree has.
bool suits(LiteralTraversal traversal, TreeKind tree);

/// The one that the errata ask for, or nothing. BSP: E4 before E10 before E5; octree: E5 before E11, because 3.4.1
/// itself prefers the box to the sphere.
std::optional<LiteralTraversal> literalTraversal(const Fidelity& fidelity, TreeKind tree);

/// Like findLeaves; a traversal that does not suit the tree finds nothing. The sphere is that within the box's first
/// edge.
void findLeavesLiterally(const Partition& partition, LiteralTraversal traversal, const Box3& box,
                         LeafHits& hits) noexcept;

}  // namespace palpate::hdb
