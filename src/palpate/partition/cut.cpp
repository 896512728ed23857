#include "palpate/partition/cut.h"

namespace palpate::partition {

namespace {

/// Where the edge meets the plane, which it crosses. The corner below the plane comes first, so that both directions
/// of an edge give the same bits.
Vec3 meetingPoint(const Vec3& below, const Vec3& above, const AxisPlane& plane) {
  const double down = plane.at - below[plane.axis];
  const double up = above[plane.axis] - plane.at;
  Vec3 point = below + (down / (down + up)) * (above - below);
  point[plane.axis] = plane.at;
  return point;
}

struct Polygon {
  std::array<Vec3, 4> corners;  // a triangle cut once has at most four
  int count = 0;
  void add(const Vec3& corner) { corners[count++] = corner; }
};

}  // namespace

Pieces clip(const std::array<Vec3, 3>& triangle, const AxisPlane& plane, bool positive) {
  const double sign = positive ? 1.0 : -1.0;
  Polygon kept;
  for (int i = 0; i < 3; ++i) {
    const Vec3& from = triangle[i];
    const Vec3& to = triangle[(i + 1) % 3];
    const double from_side = sign * (from[plane.axis] - plane.at);
    const double to_side = sign * (to[plane.axis] - plane.at);
    if (from_side >= 0.0) kept.add(from);
    const bool crosses = (from_side > 0.0 && to_side < 0.0) || (from_side < 0.0 && to_side > 0.0);
    if (!crosses) continue;
    const bool from_below = from[plane.axis] < plane.at;
    kept.add(from_below ? meetingPoint(from, to, plane) : meetingPoint(to, from, plane));
  }
  Pieces pieces;
  for (int i = 2; i < kept.count; ++i) {
    pieces.triangles[pieces.count++] = {kept.corners[0], kept.corners[i - 1], kept.corners[i]};
  }
  return pieces;
}

}  // namespace palpate::partition
