// Marks triangles where the faces of the box have passed, and links the leaves that have marks.
//
// An entry meets the box by six comparisons, one for each face. A comparison changes only for entries with a side
// between the old and the new place of that face, so a node none of whose extents reaches into one of these six slabs
// keeps its marks, whatever it holds. At 1 kHz the slabs are some tenths of a millimetre thick.
//
// Data flow: detecting box of a tick -> moveTo -> marks and links -> appendNear -> hdb_candidates.
// Based on: Ji, dissertation 2008, 6.2 (4): "a linear link to save the triangles intersected with the HDB", "a hybrid
// octree"; how the two are joined is our own.
#include "palpate/hdb/linked_triangles.h"

#include <bit>
#include <limits>

#include "palpate/hdb/detail/growth.h"

namespace palpate::hdb {

namespace {

static_assert(kBlockEntries <= 16, "a block's marks are the bits of a uint16_t");

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The places that the lower (or the upper) faces of a box have passed, axis by axis; nothing where they stayed.
Box3 passed(const Vec3& from, const Vec3& to) {
  Box3 slabs(from.cwiseMin(to), from.cwiseMax(to));
  for (int axis = 0; axis < 3; ++axis) {
    if (from[axis] != to[axis]) continue;
    slabs.min()[axis] = kInfinity;
    slabs.max()[axis] = -kInfinity;
  }
  return slabs;
}

/// Whether the extent of `box` along any axis reaches into the slab of that axis.
bool reachesInto(const Box3& box, const Box3& slabs) {
  const Vec3 &low = box.min(), &high = box.max(), &from = slabs.min(), &to = slabs.max();
  return bool(((low[0] <= to[0]) & (from[0] <= high[0])) | ((low[1] <= to[1]) & (from[1] <= high[1])) |
              ((low[2] <= to[2]) & (from[2] <= high[2])));
}

/// Links or unlinks a leaf, in the order of the entries. Leaves come and go some times a second, so the walk to the
/// place does not matter.
void link(LinkedTriangles& list, const Partition& partition, Index leaf) {
  Index before = kNoIndex, after = list.first;
  while (after != kNoIndex && partition.nodes[after].first_entry < partition.nodes[leaf].first_entry) {
    before = after;
    after = list.next[after];
  }
  list.previous[leaf] = before;
  list.next[leaf] = after;
  (before == kNoIndex ? list.first : list.next[before]) = leaf;
  if (after != kNoIndex) list.previous[after] = leaf;
  ++list.leaves;
}

void unlink(LinkedTriangles& list, Index leaf) {
  const Index before = list.previous[leaf], after = list.next[leaf];
  (before == kNoIndex ? list.first : list.next[before]) = after;
  if (after != kNoIndex) list.previous[after] = before;
  --list.leaves;
}

/// One move of the box.
struct Move {
  LinkedTriangles& list;
  const Partition& partition;
  Box3 from, to;
  Box3 lower_faces, upper_faces;  ///< regions that they passed
  Index leaf = kNoIndex;          ///< leaf of the present node

  bool mayChange(const Box3& tight) {
    ++list.boxes_moved;
    return (meets(tight, from) | meets(tight, to)) &&
           (reachesInto(tight, lower_faces) | reachesInto(tight, upper_faces));
  }

  void mark(Index index, const Node& node) {
    std::uint16_t marks = 0;
    for (Index i = 0; i < node.entry_count; ++i) {
      const bool in_box = meets(partition.boxes[node.first_entry + i], to);
      marks = static_cast<std::uint16_t>(marks | (std::uint16_t{in_box} << i));
    }
    list.boxes_moved += node.entry_count;
    const auto before = static_cast<Index>(std::popcount(list.marks[index]));
    const auto after = static_cast<Index>(std::popcount(marks));
    list.marks[index] = marks;
    list.marked[leaf] += after - before;  // unsigned: what is taken away wraps round and back
    list.triangles += std::size_t{after} - std::size_t{before};
  }

  void visit(Index index) {
    const Node& node = partition.nodes[index];
    if (node.child_count == 0) {
      mark(index, node);
      return;
    }
    for (Index child = node.first_child; child < node.first_child + node.child_count; ++child) {
      if (!mayChange(partition.nodes[child].tight)) continue;
      if (partition.nodes[child].is_leaf) {
        visitLeaf(child);
      } else {
        visit(child);
      }
    }
  }

  void visitLeaf(Index index) {
    leaf = index;
    const bool was_linked = list.marked[leaf] > 0;
    visit(index);
    if (was_linked == (list.marked[leaf] > 0)) return;
    if (was_linked) {
      unlink(list, leaf);
    } else {
      link(list, partition, leaf);
    }
  }
};

void appendFrom(LinkedTriangles& list, const Partition& partition, Index index, const Box3& near,
                std::vector<Index>& entries) {
  const Node& node = partition.nodes[index];
  ++list.boxes_found;
  if (!meets(node.tight, near)) return;
  for (Index child = node.first_child; child < node.first_child + node.child_count; ++child) {
    appendFrom(list, partition, child, near, entries);
  }
  if (node.child_count > 0) return;
  for (unsigned marks = list.marks[index]; marks != 0; marks &= marks - 1) {
    const Index entry = node.first_entry + static_cast<Index>(std::countr_zero(marks));
    ++list.boxes_found;
    if (meets(partition.boxes[entry], near)) entries.push_back(entry);
  }
}

}  // namespace

void LinkedTriangles::prepareFor(const Partition& partition) {
  marks.assign(partition.nodes.size(), 0);
  marked.assign(partition.nodes.size(), 0);
  next.assign(partition.nodes.size(), kNoIndex);
  previous.assign(partition.nodes.size(), kNoIndex);
  first = kNoIndex;
  triangles = leaves = 0;
  box.setEmpty();
}

bool moveTo(LinkedTriangles& list, const Partition& partition, const Box3& box) noexcept {
  if (list.box.min() == box.min() && list.box.max() == box.max()) return false;
  Move move{list, partition, list.box, box, {}, {}};
  if (list.box.isEmpty()) {
    move.lower_faces = move.upper_faces = Box3(Vec3::Constant(-kInfinity), Vec3::Constant(kInfinity));
  } else {
    move.lower_faces = passed(list.box.min(), box.min());
    move.upper_faces = passed(list.box.max(), box.max());
  }
  list.box = box;
  if (partition.nodes.empty() || !move.mayChange(partition.nodes[0].tight)) return true;
  if (partition.nodes[0].is_leaf) {
    move.visitLeaf(0);
  } else {
    move.visit(0);
  }
  return true;
}

void appendNear(LinkedTriangles& list, const Partition& partition, const Box3& near,
                std::vector<Index>& entries) noexcept {
  for (Index leaf = list.first; leaf != kNoIndex; leaf = list.next[leaf]) {
    appendFrom(list, partition, leaf, near, entries);
  }
}

}  // namespace palpate::hdb
