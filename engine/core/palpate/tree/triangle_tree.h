// The bounding volume tree over a triangle surface: nearest point, first crossing of a segment, triangles within a
// radius.
//
// Built once at load from a mesh (triangle_tree_build.cpp). Triangles are stored in leaf order as 96-byte records that
// hold everything a walk over the surface needs, so a query and the walk that follows it read the same cache lines.
// Queries are noexcept, allocate nothing, use a stack of fixed size and may run from any number of threads at once.
//
// All three queries visit nodes nearest first; boxes are floats that err on the safe side, triangles are doubles.
#pragma once

#include <array>
#include <bit>
#include <span>
#include <vector>

#include "palpate/base/aligned.h"
#include "palpate/base/progress.h"
#include "palpate/mesh/triangle_mesh.h"
#include "palpate/tree/closest_on_triangle.h"
#include "palpate/tree/wide_node.h"

namespace palpate::tree {

/// A triangle as a walk over the surface needs it. Triangles are named by their record's index ("leaf order")
/// everywhere in `tree` and `contact`; `TriangleTree::source_triangle` leads back to the mesh.
struct alignas(32) TriangleRecord {
  std::array<Vec3, 3> corners;      ///< mm
  std::array<Index, 3> neighbours;  ///< record across edge i = (corner i, corner i + 1); kNoIndex at a border
  std::array<Index, 3> vertices;    ///< vertex of the mesh at each corner
};

/// A part of the surface as one small plate: the view of a far point (windingNumber). In the unit frame.
struct FarPlate {
  std::array<float, 3> middle{};
  std::array<float, 3> area{};  ///< sum of its area vectors
  float far2 = 0.0f;            ///< squared distance from the middle from which on the plate is exact enough
};

struct TriangleTree {
  AlignedVector<WideNode> nodes;       ///< nodes[0] is the root
  std::vector<FarPlate> far_plates;    ///< plates of the children that a node has, node after node
  std::vector<Index> first_far_plate;  ///< one per node
  AlignedVector<TriangleRecord> records;
  std::vector<Index> source_triangle;  ///< record -> triangle of the mesh
  // The unit frame of the boxes: (position - center) * to_unit, about 1 across. to_unit is a power of two, so the
  // change of frame costs one rounding and the tree behaves the same at every scale and far from the origin.
  Vec3 center = Vec3::Zero();
  double to_unit = 1.0;
  double diagonal = 0.0;  ///< diagonal of the mesh's box, mm: the scale of tolerances
};

/// Throws Error for a mesh without triangles, with more than ChildLink::kMaxTriangles, with an index out of range or a
/// coordinate that is not finite. About 0.5 us and 150 bytes a triangle; `progress` is called every 0.1 s.
TriangleTree buildTriangleTree(const mesh::TriangleMesh& mesh, const Progress& progress = {});

/// The tree's nodes cannot nest deeper than this (the builder sees to it), which bounds the stack of every query.
inline constexpr int kMaxTreeLevels = 64;

/// Triangles that are asked side by side: those of a full leaf.
inline constexpr int kMaxSideBySide = ChildLink::kMaxTrianglesPerLeaf;

/// Results of closestOnTriangle for several triangles, to the bit.
struct alignas(kCacheLineBytes) ClosestSideBySide {
  double x[kMaxSideBySide], y[kMaxSideBySide], z[kMaxSideBySide];
  double squared_distance[kMaxSideBySide];
  double feature[kMaxSideBySide];  ///< the Feature's number

  ClosestOnTriangle operator[](int i) const {
    return {{x[i], y[i], z[i]}, static_cast<Feature>(static_cast<int>(feature[i])), squared_distance[i]};
  }
  void set(int i, const ClosestOnTriangle& closest) {
    x[i] = closest.point.x();
    y[i] = closest.point.y();
    z[i] = closest.point.z();
    squared_distance[i] = closest.squared_distance;
    feature[i] = static_cast<double>(closest.feature);
  }
};

/// Closest points on the records `which`, 1 to kMaxSideBySide of them.
void closestOnTriangles(const TriangleRecord* records, const Index* which, int count, const Vec3& point,
                        ClosestSideBySide& closest) noexcept;

struct NearestPoint {
  ClosestOnTriangle closest;
  Index triangle = kNoIndex;  ///< record
};

struct Crossing {
  Vec3 point;                 ///< on the triangle, to rounding
  double fraction = 0.0;      ///< share of the segment, [0, 1]
  Index triangle = kNoIndex;  ///< record
};

/// The nearest point of the surface closer than `max_distance`, or triangle kNoIndex.
NearestPoint nearestPoint(const TriangleTree& tree, const Vec3& point, double max_distance) noexcept;

/// Where the segment first passes a triangle from its front to its back (exactly, see exact_predicates.h), or triangle
/// kNoIndex.
Crossing firstFrontCrossing(const TriangleTree& tree, const Vec3& from, const Vec3& to) noexcept;

/// The same of these records alone.
Crossing firstFrontCrossingAmong(const TriangleTree& tree, std::span<const Index> records, const Vec3& from,
                                 const Vec3& to) noexcept;

// The same queries with the caller's own test, for those who need one (contact). Templates, so that it is inlined.

namespace detail {

struct PendingChild {
  float bound;
  ChildLink child;
};

inline constexpr int kMaxPending = kMaxTreeLevels * (kNodeWidth - 1) + 1;

PointQuery pointQuery(const TriangleTree& tree, const Vec3& point) noexcept;
SegmentQuery segmentQuery(const TriangleTree& tree, const Vec3& from, const Vec3& to) noexcept;
/// A squared distance in mm^2 as a float of the unit frame, rounded up.
float unitSquaredDistance(const TriangleTree& tree, double squared_distance) noexcept;

/// Puts the children within `limit` on the stack, the nearest on top. Returns the new stack size.
int pushNearestLast(const WideNode& node, const float* bounds, float limit, PendingChild* stack, int size) noexcept;

/// True for a crossing, with its fraction and place.
bool crossingOf(const TriangleRecord& record, const Vec3& from, const Vec3& to, Crossing& crossing) noexcept;

/// Keeps the earlier of two crossings, or that of the lower record.
void keepEarlier(const Crossing& crossing, Crossing& first) noexcept;

}  // namespace detail

namespace detail {

/// Adds a leaf's records to `count` others. Returns how many there are then.
inline int listTriangles(ChildLink leaf, Index* which, int count) noexcept {
  const int end = count + static_cast<int>(leaf.triangleCount());
  for (Index t = leaf.firstTriangle(); count < end; ++t) which[count++] = t;
  return count;
}

/// Branch and bound; `bounds_of(node, query, bounds)` fills the lower bounds of the squared distances to the children.
template <class Bounds, class Visit>
void visitNearestFirst(const TriangleTree& tree, const Vec3& point, double squared_limit, Bounds&& bounds_of,
                       Visit&& visit) noexcept {
  const PointQuery query = pointQuery(tree, point);
  PendingChild stack[kMaxPending];
  stack[0] = {0.0f, ChildLink::toNode(0)};
  float unit_limit = unitSquaredDistance(tree, squared_limit);
  for (int size = 1; size > 0;) {
    const PendingChild next = stack[--size];
    if (next.bound > unit_limit) continue;
    if (!next.child.isLeaf()) {
      const WideNode& node = tree.nodes[next.child.node()];
      float bounds[kNodeWidth];
      bounds_of(node, query, bounds);
      size = pushNearestLast(node, bounds, unit_limit, stack, size);
      continue;
    }
    Index which[kMaxSideBySide];
    int count = listTriangles(next.child, which, 0);
    // Leaves that come next anyway are asked along with it.
    while (size > 0 && stack[size - 1].child.isLeaf() &&
           count + static_cast<int>(stack[size - 1].child.triangleCount()) <= kMaxSideBySide) {
      count = listTriangles(stack[--size].child, which, count);
    }
    ClosestSideBySide closest;
    closestOnTriangles(tree.records.data(), which, count, point, closest);
    for (int i = 0; i < count; ++i) {
      if (!(closest.squared_distance[i] < squared_limit)) continue;
      squared_limit = visit(which[i], closest[i]);
      if (squared_limit <= 0.0) return;
    }
    unit_limit = unitSquaredDistance(tree, squared_limit);
  }
}

}  // namespace detail

/// Calls visit(record, ClosestOnTriangle) for triangles nearer than the square root of `squared_limit`, roughly nearest
/// first. `visit` returns the new limit, smaller or equal; 0 ends the search.
template <class Visit>
void visitNearTriangles(const TriangleTree& tree, const Vec3& point, double squared_limit, Visit&& visit) noexcept {
  detail::visitNearestFirst(tree, point, squared_limit, squaredDistanceBounds, visit);
}

/// The same, but leaves out many triangles (not all) that hold no local minimum of the distance that has the point in
/// front of it.
template <class Visit>
void visitNearMinima(const TriangleTree& tree, const Vec3& point, double squared_limit, Visit&& visit) noexcept {
  detail::visitNearestFirst(tree, point, squared_limit, squaredDistanceBoundsOfMinima, visit);
}

/// Nearest point among those that accept(record, ClosestOnTriangle) is true for.
template <class Accept>
NearestPoint nearestPointIf(const TriangleTree& tree, const Vec3& point, double max_distance,
                            Accept&& accept) noexcept {
  NearestPoint best;
  double squared_limit = max_distance * max_distance;
  visitNearTriangles(tree, point, squared_limit, [&](Index triangle, const ClosestOnTriangle& closest) {
    if (accept(triangle, closest)) {
      best = {closest, triangle};
      squared_limit = closest.squared_distance;
    }
    return squared_limit;
  });
  return best;
}

/// Calls visit(record) for every triangle whose box the segment may touch.
template <class Visit>
void visitTrianglesAlong(const TriangleTree& tree, const Vec3& from, const Vec3& to, Visit&& visit) noexcept {
  const SegmentQuery query = detail::segmentQuery(tree, from, to);
  ChildLink stack[detail::kMaxPending];
  stack[0] = ChildLink::toNode(0);
  for (int size = 1; size > 0;) {
    const ChildLink next = stack[--size];
    if (next.isLeaf()) {
      const Index end = next.firstTriangle() + next.triangleCount();
      for (Index t = next.firstTriangle(); t < end; ++t) visit(t);
      continue;
    }
    const WideNode& node = tree.nodes[next.node()];
    for (std::uint32_t hits = segmentMayTouch(node, query); hits != 0; hits &= hits - 1) {
      stack[size++] = node.children[std::countr_zero(hits)];
    }
  }
}

/// First front-to-back crossing of a triangle that accept(record) is true for. Among crossings at the same fraction the
/// one with the lower record wins.
template <class Accept>
Crossing firstFrontCrossingIf(const TriangleTree& tree, const Vec3& from, const Vec3& to, Accept&& accept) noexcept {
  Crossing first;
  visitTrianglesAlong(tree, from, to, [&](Index t) {
    Crossing crossing;
    if (!detail::crossingOf(tree.records[t], from, to, crossing) || !accept(t)) return;
    crossing.triangle = t;
    detail::keepEarlier(crossing, first);
  });
  return first;
}

/// Fills the plates of the tree's nodes (wide_node.h) - how the surface in each child faces, how thick it is across
/// that direction and how far its normals spread - from its records; the last step of buildTriangleTree. About 0.1 us a
/// triangle.
void fillPlates(TriangleTree& tree, const Progress& progress = {});

// Inside or outside: how often a surface winds round a point.

/// Approximates the surface below each child of a node: one small plate with its area and facing. Fills
/// TriangleTree::far_plates; called by buildTriangleTree.
void fillFarPlates(TriangleTree& tree);

/// The generalised winding number: 1 inside a closed surface and 0 outside of it (negative in a part that is inside
/// out, more than 1 where bodies overlap, in between where a sheet is open). Within 0.05 of the exact sum of solid
/// angles for bodies; a point on the surface is in between. About 1 us at 3,000 triangles and 3 us at 1,000,000.
double windingNumber(const TriangleTree& tree, const Vec3& point) noexcept;

// Thickness of a body under each of its vertices, as far as a dent can be deep.

/// The way from a place of the skin along `inwards` (unit) to where it leaves the body, at most `most_mm`: infinite
/// where it does not leave within that. mm. About 0.3 us.
double wayThrough(const TriangleTree& tree, const Vec3& place, const Vec3& inwards, double most_mm) noexcept;

/// Per vertex of `tree`'s mesh the way against `normals[v]` (unit, out of the body) from the vertex to where it leaves
/// the body, at most `most_mm`: infinite where it does not leave within that. mm. About 0.3 us a vertex: it looks no
/// farther. A normal may be zero or not finite: infinite.
std::vector<float> thicknessUpTo(const TriangleTree& tree, const std::vector<Vec3>& positions,
                                 const std::vector<Vec3>& normals, double most_mm);

}  // namespace palpate::tree
