// The haptic detecting box (HDB): an axis-aligned box centred on the proxy; the finger may touch the triangles that it
// meets.
//
// Two questions: which leaves does it meet (the dissertation's haptic process works on all their triangles), and which
// triangles exactly have a box that meets it. A box test is closed: touching counts. Both use the tight boxes of the
// nodes (E5) and go into each child on its own test (E4), so no triangle is missed whatever the tree, the assignment
// and the threshold; literal_traversal.h has the forms as printed.
//
// Queries are noexcept, allocate nothing once the result was prepared for the partition, and may run from any number of
// threads, each with a result of its own.
//
// Based on: Ji (2008), 3.3.3 and 3.4.1.
#pragma once

#include <cstdint>
#include <vector>

#include "palpate/hdb/partition.h"

namespace palpate::hdb {

/// The length of which 3.3.3 takes "1/4" (E12).
enum class HdbSize : std::uint8_t {
  QuarterOfLongestEdge,  ///< a cube
  QuarterOfBox           ///< as wide, high and deep as a quarter of the model's box
};

/// The edges of the HDB along x, y, z in mm for a model in this box; zero for an empty one.
Vec3 hdbEdges(const Box3& model, HdbSize size = HdbSize::QuarterOfLongestEdge);

inline Box3 hapticBox(const Vec3& proxy, const Vec3& edges) { return {proxy - 0.5 * edges, proxy + 0.5 * edges}; }
inline Box3 hapticBox(const Vec3& proxy, double edge_mm) { return hapticBox(proxy, Vec3::Constant(edge_mm)); }

/// Whether two boxes have a point in common. No branches between the six comparisons: near the border of a box each is
/// a coin toss.
inline bool meets(const Box3& a, const Box3& b) {
  const Vec3 &a_low = a.min(), &a_high = a.max(), &b_low = b.min(), &b_high = b.max();
  return bool((a_low[0] <= b_high[0]) & (a_low[1] <= b_high[1]) & (a_low[2] <= b_high[2]) & (b_low[0] <= a_high[0]) &
              (b_low[1] <= a_high[1]) & (b_low[2] <= a_high[2]));
}

/// The edge that follows from how fast the box can be, in place of the quarter (E12): the finger moves `speed` mm/s for
/// `delay_s` before the box follows, and its proxy is up to `margin_mm` from the tip. With the depth for the margin
/// none of the strokes of `palpate study hdb` got through; that is measured, not proved (twice the depth follows from
/// the triangle inequality). E12's margin, the largest triangle, is outrun on fine models.
double leastHdbEdge(double speed, double delay_s, double margin_mm);

/// Entries [begin, end) of a partition.
struct EntryRange {
  Index begin = 0;
  Index end = 0;
  Index size() const { return end - begin; }
  friend bool operator==(const EntryRange&, const EntryRange&) = default;
};

/// Cost of a leaf query.
struct QueryCost {
  Index nodes_tested = 0;   ///< nodes whose box (or half-space) was tested
  Index nodes_entered = 0;  ///< the root, and those that passed their test
};

/// Leaves that a box meets. Reused from query to query.
struct LeafHits {
  std::vector<Index> leaves;  ///< nodes of the partition, in the order of their entries
  QueryCost cost;

  /// Room for every leaf: after this no query allocates.
  void prepareFor(const Partition& partition) { leaves.reserve(partition.leaves.size()); }
};

/// Triangles whose boxes meet a box. Reused from query to query.
struct TriangleHits {
  std::vector<EntryRange> ranges;                ///< ascending; no two touch
  std::vector<Index> triangles;                  ///< triangles of the mesh, each once; filled by listTriangles only
  std::vector<std::uint32_t> stamp_of_triangle;  ///< for partitions that repeat triangles: the last list it was in
  std::uint32_t stamp = 0;

  /// Room for the most ranges that can be, every other entry, and for every triangle: after this no query allocates.
  void prepareFor(const Partition& partition);
};

/// The leaves whose tight box meets `box`.
void findLeaves(const Partition& partition, const Box3& box, LeafHits& hits) noexcept;

/// The leaves whose tight box has a point within `radius` mm of the centre: the sphere of 3.4.1, tested by the closest
/// point of the box (E11).
void findLeavesInSphere(const Partition& partition, const Vec3& centre, double radius, LeafHits& hits) noexcept;

/// The entries whose triangle's box meets `box`, as ranges: a subtree inside the box is one range, however large.
void findTriangles(const Partition& partition, const Box3& box, TriangleHits& hits) noexcept;

/// Writes out the triangles of `hits.ranges`, each once, in the order of the entries.
void listTriangles(const Partition& partition, TriangleHits& hits) noexcept;

/// Number of entries of the leaves: what the dissertation's haptic process draws.
std::size_t entriesIn(const Partition& partition, const std::vector<Index>& leaves) noexcept;
std::size_t entriesIn(const std::vector<EntryRange>& ranges) noexcept;

}  // namespace palpate::hdb
