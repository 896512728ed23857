// The hybrid of octree and linked list that the dissertation's fourth piece of future work suggests: the leaves that
// hold triangles of the haptic detecting box are linked, and the triangles themselves are marked inside them.
//
// Nothing is listed again when the box moves: the tree is descended only where a face of the box has passed, and there
// triangles are marked or unmarked. The list is exact at every tick, unlike the coherent list, which has a margin.
// Triangles near a place are found along the linked leaves and down from each, so that most of the list is not looked
// at.
#pragma once

#include <cstdint>
#include <vector>

#include "palpate/hdb/haptic_box.h"

namespace palpate::hdb {

/// One list per finger, for one partition. About 3 bytes a triangle of the body.
struct LinkedTriangles {
  // One per node of the partition.
  std::vector<std::uint16_t> marks;  ///< nodes without children: bit i is set when their entry i meets the box
  std::vector<Index> marked;         ///< leaves: how many of their entries are marked
  std::vector<Index> next;           ///< linked leaves: in the order of their entries; kNoIndex ends the list
  std::vector<Index> previous;

  Index first = kNoIndex;         ///< first linked leaf
  std::size_t triangles = 0;      ///< marked entries
  std::size_t leaves = 0;         ///< linked
  Box3 box;                       ///< box of the marks; empty before the first move
  std::uint64_t boxes_moved = 0;  ///< boxes of nodes and of triangles that moves have tested
  std::uint64_t boxes_found = 0;  ///< boxes of nodes and of triangles that appendNear has tested

  /// Room for this partition; forgets the present list.
  void prepareFor(const Partition& partition);
};

/// Makes the list hold the entries whose triangle's box meets `box`. False when the box has not moved. Allocates
/// nothing after prepareFor.
bool moveTo(LinkedTriangles& list, const Partition& partition, const Box3& box) noexcept;

/// Appends the listed entries whose box meets `near`, in the order of the entries.
void appendNear(LinkedTriangles& list, const Partition& partition, const Box3& near,
                std::vector<Index>& entries) noexcept;

}  // namespace palpate::hdb
