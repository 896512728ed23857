// Finds the feet of a sphere with one query of the tree, without duplicates.
#include "palpate/contact/sphere_feet.h"

#include <cmath>
#include <limits>

#include "palpate/contact/surface_walk.h"

namespace palpate::contact {

using partition::ClosestOnTriangle;

namespace {

/// Sine of the angle below which a neighbouring triangle does not count as leading nearer: rounding of a tangent.
constexpr double kLevel = 1e-12;
/// Feet closer together than this share of the centre's distance are one foot found from several triangles.
constexpr double kSameFoot = 1e-9;

SurfacePoint placeOf(Index triangle, const ClosestOnTriangle& closest) {
  return {closest.point, triangle, closest.feature};
}

bool inFront(const Surface& surface, Index triangle, const ClosestOnTriangle& closest, const Vec3& centre) {
  return (centre - closest.point).dot(normalAt(surface, placeOf(triangle, closest))) > 0.0;
}

/// Whether moving from the closest point into the triangles next to it leads away from the centre. Only directions to
/// their far corners have to be asked, because the closest point is stationary within its own triangle.
bool isLocalMinimum(const Surface& surface, Index triangle, const ClosestOnTriangle& closest, const Vec3& centre) {
  if (closest.feature == partition::Feature::face) return true;
  const auto& records = surface.tree.records;
  const Vec3 to_centre = centre - closest.point;
  const auto leads_nearer = [&](const Vec3& corner) {
    const Vec3 towards = corner - closest.point;
    const double slope = to_centre.dot(towards);
    return slope > 0.0 && slope * slope > kLevel * kLevel * to_centre.squaredNorm() * towards.squaredNorm();
  };
  const int index = partition::indexOf(closest.feature);
  if (partition::isEdge(closest.feature)) {
    const Index across = records[triangle].neighbours[index];
    if (across == kNoIndex) return true;
    const Index start = records[triangle].vertices[index];
    for (int i = 0; i < 3; ++i) {
      if (records[across].vertices[i] == start) return !leads_nearer(records[across].corners[(i + 1) % 3]);
    }
    return true;
  }
  bool minimum = true;
  visitFan(surface, triangle, index, [&](Index t, int corner) {
    minimum = minimum && !leads_nearer(records[t].corners[(corner + 1) % 3]) &&
              !leads_nearer(records[t].corners[(corner + 2) % 3]);
  });
  return minimum;
}

bool isKnown(const Feet& feet, const Foot& foot) {
  const double same = kSameFoot * foot.distance;
  for (int i = 0; i < feet.count; ++i) {
    if ((feet.feet[i].at.position - foot.at.position).squaredNorm() <= same * same) return true;
  }
  return false;
}

void keep(const Foot& foot, Feet& feet) {
  if (isKnown(feet, foot)) return;
  if (feet.count < Feet::kMost) {
    feet.feet[feet.count++] = foot;
    return;
  }
  int farthest = 0;
  for (int i = 1; i < Feet::kMost; ++i) {
    if (feet.feet[i].distance > feet.feet[farthest].distance) farthest = i;
  }
  if (foot.distance < feet.feet[farthest].distance) feet.feet[farthest] = foot;
}

}  // namespace

const Foot& Feet::nearest() const {
  int best = 0;
  for (int i = 1; i < count; ++i) {
    if (feet[i].distance < feet[best].distance) best = i;
  }
  return feet[best];
}

double Feet::nearestDistance() const {
  return count > 0 ? nearest().distance : std::numeric_limits<double>::infinity();
}

void findFeet(const Surface& surface, const Vec3& centre, double reach, Feet& feet) noexcept {
  feet.count = 0;
  const double limit = reach * reach;
  visitNearTriangles(surface.tree, centre, limit, [&](Index triangle, const ClosestOnTriangle& closest) {
    if (!isLocalMinimum(surface, triangle, closest, centre) || !inFront(surface, triangle, closest, centre)) {
      return limit;
    }
    Foot foot;
    foot.at = placeOf(triangle, closest);
    foot.distance = std::sqrt(closest.squared_distance);
    foot.normal = (centre - closest.point) / foot.distance;
    keep(foot, feet);
    return limit;
  });
}

bool anyFrontNearer(const Surface& surface, const Vec3& centre, double distance) noexcept {
  bool any = false;
  const double limit = distance * distance;
  visitNearTriangles(surface.tree, centre, limit, [&](Index triangle, const ClosestOnTriangle& closest) {
    any = inFront(surface, triangle, closest, centre);
    return any ? 0.0 : limit;
  });
  return any;
}

partition::NearestPoint nearestFront(const Surface& surface, const Vec3& centre, double reach) noexcept {
  return nearestPointIf(surface.tree, centre, reach, [&](Index triangle, const ClosestOnTriangle& closest) {
    return inFront(surface, triangle, closest, centre);
  });
}

HalfSpace keepOff(const Foot& foot, double radius) noexcept {
  return {foot.normal, foot.normal.dot(foot.at.position) + radius};
}

}  // namespace palpate::contact
