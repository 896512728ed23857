// The cut by walking: from the crossed triangle nearest to the origin over shared edges, backward and forward, until
// the width, a border or the start. A point on the plane counts as above it, so every triangle is crossed twice or
// never.
#include "palpate/view/overlays/section.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "palpate/base/language.h"
#include "palpate/tree/triangle_tree.h"

namespace palpate::view {

namespace {

using tree::TriangleRecord;
using Deformed = std::function<Vec3(Index)>;

/// Shorter drags (mm) give no direction.
constexpr double kMinDragMm = 0.2;

Vec3 sectionDirection(const Vec3& normal) {
  const Vec3 side = Vec3::UnitX() - normal.x() * normal;
  constexpr double kMinSide = 1e-3;  // the skin faces along x: go along the body instead
  return side.norm() > kMinSide ? Vec3(side.normalized()) : Vec3((Vec3::UnitY() - normal.y() * normal).normalized());
}

/// Points on the plane count as above it, so that every triangle is crossed at two edges or none.
class Side {
 public:
  explicit Side(const SectionPlane& plane) : origin_(plane.origin), normal_(plane.along.cross(plane.upward)) {}
  double distance(const Vec3& p) const { return (p - origin_).dot(normal_); }
  bool crosses(const Vec3& a, const Vec3& b) const { return (distance(a) >= 0.0) != (distance(b) >= 0.0); }
  double fraction(const Vec3& a, const Vec3& b) const { return distance(a) / (distance(a) - distance(b)); }

 private:
  Vec3 origin_, normal_;
};

Vec2 inPlane(const SectionPlane& plane, const Vec3& p) {
  return {(p - plane.origin).dot(plane.along), (p - plane.origin).dot(plane.upward)};
}

SectionPoint crossingAt(const TriangleRecord& record, int edge, const Deformed& deformed, const SectionPlane& plane,
                        const Side& side) {
  const int next = (edge + 1) % 3;
  const double t = side.fraction(record.corners[edge], record.corners[next]);
  const auto between = [&](const Vec3& a, const Vec3& b) { return inPlane(plane, a + t * (b - a)); };
  return {between(record.corners[edge], record.corners[next]),
          between(deformed(record.vertices[edge]), deformed(record.vertices[next]))};
}

bool isCrossed(const TriangleRecord& record, int edge, const Side& side) {
  return side.crosses(record.corners[edge], record.corners[(edge + 1) % 3]);
}

/// The two crossed edges of a triangle, the one farther along the plane second.
struct CrossedEdges {
  int backward = 0;
  int forward = 0;
};

std::optional<CrossedEdges> crossedEdges(const TriangleRecord& record, const Deformed& deformed,
                                         const SectionPlane& plane, const Side& side) {
  int edges[3];
  int count = 0;
  for (int edge = 0; edge < 3; ++edge) {
    if (isCrossed(record, edge, side)) edges[count++] = edge;
  }
  if (count != 2) return std::nullopt;
  const auto place_of = [&](int edge) { return crossingAt(record, edge, deformed, plane, side).rest.x(); };
  if (place_of(edges[0]) > place_of(edges[1])) std::swap(edges[0], edges[1]);
  return CrossedEdges{edges[0], edges[1]};
}

/// The crossed triangle nearest to the plane's origin.
Index findStartTriangle(const tree::TriangleTree& tree, const SectionPlane& plane, const Side& side) {
  constexpr double kReachMm = 5.0;  // the origin is on the skin; a corner's own triangles may all be on one side
  const auto found = tree::nearestPointIf(tree, plane.origin, kReachMm, [&](Index record, const auto&) {
    const TriangleRecord& r = tree.records[record];
    return isCrossed(r, 0, side) || isCrossed(r, 1, side) || isCrossed(r, 2, side);
  });
  return found.triangle;
}

struct Walk {
  std::vector<SectionPoint> points;
  bool came_round = false;  ///< a closed body, back to the first triangle
};

/// Walks over the surface from a triangle's edge on, as far as the width, a border, or round a closed body.
Walk walked(const tree::TriangleTree& tree, const Deformed& deformed, const SectionPlane& plane, const Side& side,
            Index record, int edge, double width) {
  Walk walk;
  const Index start = record;
  while (true) {
    walk.points.push_back(crossingAt(tree.records[record], edge, deformed, plane, side));
    if (std::abs(walk.points.back().rest.x()) > width) break;
    const Index next = tree.records[record].neighbours[edge];
    walk.came_round = next == start;
    if (next == kNoIndex || next == start) break;
    const auto& back = tree.records[next].neighbours;
    const int came_through = static_cast<int>(std::find(back.begin(), back.end(), record) - back.begin());
    edge = (came_through + 1) % 3;
    if (!isCrossed(tree.records[next], edge, side)) edge = (came_through + 2) % 3;
    record = next;
  }
  return walk;
}

SectionEnds endsNamed(const char* low, const char* high) {
  return {std::string("A ") + tr(low), std::string("B ") + tr(high)};
}

}  // namespace

const FingerMark* sectionFinger(std::span<const FingerMark> fingers) {
  const FingerMark* found = nullptr;
  for (const FingerMark& finger : fingers) {
    if (finger.contact.touch == contact::Touch::free) continue;
    if (found == nullptr || finger.contact.depth_mm > found->contact.depth_mm) found = &finger;
  }
  return found != nullptr || fingers.empty() ? found : &fingers.front();
}

SectionEnds sectionEnds(const SectionPlane& plane) {
  constexpr double kClearly = 0.8;  // within 37 degrees of the axis
  if (std::abs(plane.along.x()) > kClearly) {
    return plane.along.x() > 0.0 ? endsNamed("left", "right") : endsNamed("right", "left");
  }
  if (std::abs(plane.along.y()) > kClearly) {
    return plane.along.y() > 0.0 ? endsNamed(toTranslate("caudal"), "cranial") : endsNamed("cranial", "caudal");
  }
  return {"A", "B"};
}

SectionPlane sectionPlane(const scene::World& world, const contact::FingerOutput& contact) {
  SectionPlane plane;
  plane.origin = contact.anchor;
  plane.upward = contact.normal;
  if (contact.touch == contact::Touch::free) {
    const auto nearest =
        tree::nearestPoint(world.surface.geometry->tree, contact.tip, std::numeric_limits<double>::max());
    if (nearest.triangle == kNoIndex) return plane;
    const auto& c = world.surface.geometry->tree.records[nearest.triangle].corners;
    plane.origin = nearest.closest.point;
    plane.upward = mesh::areaVector2(c[0], c[1], c[2]).normalized();
  }
  const Vec3 drag = contact.proxy - contact.anchor;
  const Vec3 in_skin = drag - drag.dot(plane.upward) * plane.upward;
  plane.along = in_skin.norm() > kMinDragMm ? Vec3(in_skin.normalized()) : sectionDirection(plane.upward);
  return plane;
}

std::vector<SectionPoint> sectionCurve(const scene::World& world, const Deformed& deformed, const SectionPlane& plane,
                                       double half_width_mm) {
  const tree::TriangleTree& tree = world.surface.geometry->tree;
  const Side side(plane);
  const Index start = findStartTriangle(tree, plane, side);
  if (start == kNoIndex) return {};
  const auto edges = crossedEdges(tree.records[start], deformed, plane, side);
  if (!edges) return {};
  Walk backward = walked(tree, deformed, plane, side, start, edges->backward, half_width_mm);
  std::vector<SectionPoint> curve = std::move(backward.points);
  std::reverse(curve.begin(), curve.end());
  if (backward.came_round) {
    curve.push_back(SectionPoint(curve.front()));
    return curve;
  }
  const Walk forward = walked(tree, deformed, plane, side, start, edges->forward, half_width_mm);
  curve.insert(curve.end(), forward.points.begin(), forward.points.end());
  return curve;
}

std::vector<SectionPoint> sectionCurve(const scene::World& world, const deform::DeformedSurface& surface,
                                       const SectionPlane& plane, double half_width_mm) {
  return sectionCurve(
      world, [&](Index v) { return surface.placeAt(v); }, plane, half_width_mm);
}

}  // namespace palpate::view
