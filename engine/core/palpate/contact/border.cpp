// The fade of the force beyond a border. It is not exactly conservative inside a strip as wide as the depth (press at
// the edge, move in, lift: a little energy is gained); the passivity control of `servo` covers that.
#include "palpate/contact/border.h"

#include <algorithm>

#include "palpate/contact/surface_walk.h"

namespace palpate::contact {

namespace {

/// In the plane of the triangle, away from it across one of its edges.
Vec3 outwards(const tree::TriangleRecord& record, int edge) {
  const Vec3 normal = mesh::areaVector2(record.corners[0], record.corners[1], record.corners[2]);
  return (record.corners[(edge + 1) % 3] - record.corners[edge]).cross(normal).stableNormalized();
}

}  // namespace

double beyondBorder(const Surface& surface, const SurfacePoint& place, const Vec3& point) noexcept {
  const auto& records = surface.geometry->tree.records;
  const Vec3 offset = point - place.position;
  if (!onBorder(surface, place)) return 0.0;
  const int index = tree::indexOf(place.feature);
  if (tree::isEdge(place.feature)) return std::max(0.0, offset.dot(outwards(records[place.triangle], index)));
  // At a corner the farther of the two edges counts: continuous with both.
  double beyond = 0.0;
  visitFan(surface, place.triangle, index, [&](Index t, int corner) {
    for (const int edge : {corner, (corner + 2) % 3}) {
      if (records[t].neighbours[edge] == kNoIndex) beyond = std::max(beyond, offset.dot(outwards(records[t], edge)));
    }
  });
  return beyond;
}

double depthAtBorder(const Vec3& place, const Vec3& normal, const Vec3& tip, double radius, double beyond) noexcept {
  return radius + (place - tip).dot(normal) - beyond;
}

}  // namespace palpate::contact
