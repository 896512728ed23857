// The queries of the triangle tree that are not templates, and the pieces the templates are made of.
//
// Based on: Wald et al. (2008) for the wide tree; Roussopoulos, Kelley, Vincent, "Nearest neighbor queries" (1995) for
// branch and bound, nearest first.
#include "palpate/tree/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "palpate/tree/exact_predicates.h"

namespace palpate::tree {

namespace detail {

namespace {

/// One rounding to float is at most 6e-8 of the value; twice that, so that the change of frame is covered too.
constexpr float kFloatRounding = 1.2e-7f;
/// Rounding of a difference of two coordinates and of its product with the segment, in units of the largest of them.
constexpr float kAxisRounding = 4e-7f;
/// Rounding of a point's coordinate and of its product with a direction, summed over three axes, in units of the
/// largest coordinate.
constexpr float kPointRounding = 5e-7f;

float roundedDown(double value) {
  const auto nearest = static_cast<float>(value);
  return nearest - std::abs(nearest) * kFloatRounding - std::numeric_limits<float>::min();
}

float roundedUp(double value) { return -roundedDown(-value); }

}  // namespace

PointQuery pointQuery(const TriangleTree& tree, const Vec3& point) noexcept {
  PointQuery query;
  double largest = 1.0;  // boxes reach about 1 from the origin of the unit frame
  for (int axis = 0; axis < 3; ++axis) {
    const double unit = (point[axis] - tree.center[axis]) * tree.to_unit;
    query.low[axis] = roundedDown(unit);
    query.high[axis] = roundedUp(unit);
    query.middle[axis] = static_cast<float>(unit);
    largest = std::max(largest, std::abs(unit));
  }
  query.slack = static_cast<float>(largest) * kPointRounding;
  return query;
}

SegmentQuery segmentQuery(const TriangleTree& tree, const Vec3& from, const Vec3& to) noexcept {
  SegmentQuery query;
  double largest = 1.0;  // boxes reach about 1 from the origin of the unit frame
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (from[axis] - tree.center[axis]) * tree.to_unit;
    const double b = (to[axis] - tree.center[axis]) * tree.to_unit;
    query.low[axis] = roundedDown(std::min(a, b));
    query.high[axis] = roundedUp(std::max(a, b));
    query.middle[axis] = static_cast<float>(0.5 * (a + b));
    query.half[axis] = static_cast<float>(0.5 * (b - a));
    largest = std::max({largest, std::abs(a), std::abs(b)});
  }
  query.slack = static_cast<float>(largest) * kAxisRounding;
  return query;
}

float unitSquaredDistance(const TriangleTree& tree, double squared_distance) noexcept {
  constexpr double kLargest = 1e38;
  return roundedUp(std::min(squared_distance * tree.to_unit * tree.to_unit, kLargest));
}

int pushNearestLast(const WideNode& node, const float* bounds, float limit, PendingChild* stack, int size) noexcept {
  const int base = size;
  std::uint32_t near = 0;
  for (int i = 0; i < kNodeWidth; ++i) near |= static_cast<std::uint32_t>(bounds[i] <= limit) << i;
  for (; near != 0; near &= near - 1) {
    const int i = std::countr_zero(near);
    const float bound = bounds[i];
    int place = size++;
    for (; place > base && stack[place - 1].bound < bound; --place) stack[place] = stack[place - 1];
    stack[place] = {bound, node.children[i]};
  }
  return size;
}

bool crossingOf(const TriangleRecord& record, const Vec3& from, const Vec3& to, Crossing& crossing) noexcept {
  const auto& [a, b, c] = record.corners;
  if (!crossesFrontToBack(a, b, c, from, to)) return false;
  // Only where along the segment is rounded here; whether it crosses was exact.
  const Vec3 normal = (b - a).cross(c - a);
  const double before = std::max(0.0, normal.dot(from - a));
  const double after = std::max(0.0, -normal.dot(to - a));
  crossing.fraction = before > 0.0 ? before / (before + after) : 0.0;
  crossing.point = closestOnTriangle(record.corners, from + crossing.fraction * (to - from)).point;
  return true;
}

void keepEarlier(const Crossing& crossing, Crossing& first) noexcept {
  const bool earlier = first.triangle == kNoIndex || crossing.fraction < first.fraction ||
                       (crossing.fraction == first.fraction && crossing.triangle < first.triangle);
  if (earlier) first = crossing;
}

}  // namespace detail

NearestPoint nearestPoint(const TriangleTree& tree, const Vec3& point, double max_distance) noexcept {
  return nearestPointIf(tree, point, max_distance, [](Index, const ClosestOnTriangle&) { return true; });
}

Crossing firstFrontCrossing(const TriangleTree& tree, const Vec3& from, const Vec3& to) noexcept {
  return firstFrontCrossingIf(tree, from, to, [](Index) { return true; });
}

Crossing firstFrontCrossingAmong(const TriangleTree& tree, std::span<const Index> records, const Vec3& from,
                                 const Vec3& to) noexcept {
  Crossing first;
  for (const Index t : records) {
    Crossing crossing;
    if (!detail::crossingOf(tree.records[t], from, to, crossing)) continue;
    crossing.triangle = t;
    detail::keepEarlier(crossing, first);
  }
  return first;
}

}  // namespace palpate::tree
