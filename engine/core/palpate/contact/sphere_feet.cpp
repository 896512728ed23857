// Finds the feet of a sphere with one query of the tree, without duplicates.
#include "palpate/contact/sphere_feet.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "palpate/contact/border.h"
#include "palpate/contact/press.h"
#include "palpate/contact/surface_walk.h"

namespace palpate::contact {

using tree::ClosestOnTriangle;

namespace {

/// Sine of the angle below which a neighbouring triangle does not count as leading nearer: rounding of a tangent.
constexpr double kLevel = 1e-12;
/// Feet closer together than this share of the centre's distance are one foot found from several triangles.
constexpr double kSameFoot = 1e-9;

SurfacePoint placeOf(Index triangle, const ClosestOnTriangle& closest) {
  return {closest.point, triangle, closest.feature};
}

/// Whether moving from the closest point into the triangles next to it leads away from the centre. Only directions to
/// their far corners have to be asked, because the closest point is stationary within its own triangle.
bool isLocalMinimum(const Surface& surface, Index triangle, const ClosestOnTriangle& closest, const Vec3& centre) {
  if (closest.feature == tree::Feature::face) return true;
  const auto& records = surface.geometry->tree.records;
  const Vec3 to_centre = centre - closest.point;
  // A centre on the skin is as near as can be; what is left of the direction is rounding.
  if (to_centre.norm() <= directionlessDepth(surface)) return true;
  const auto leads_nearer = [&](const Vec3& corner) {
    const Vec3 towards = corner - closest.point;
    const double slope = to_centre.dot(towards);
    return slope > 0.0 && slope * slope > kLevel * kLevel * to_centre.squaredNorm() * towards.squaredNorm();
  };
  const int index = tree::indexOf(closest.feature);
  if (tree::isEdge(closest.feature)) {
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
    return minimum;
  });
  return minimum;
}

/// Whether a way from the place leads to the front of the skin. On a face its normal's length does not matter, and is
/// what costs.
bool isInFront(const Surface& surface, const SurfacePoint& place, const Vec3& way) {
  if (place.feature != tree::Feature::face) return way.dot(normalAt(surface, place)) > 0.0;
  const auto& [a, b, c] = surface.geometry->tree.records[place.triangle].corners;
  return way.dot(mesh::areaVector2(a, b, c)) > 0.0;
}

bool isKnown(const Feet& feet, const SurfacePoint& place, double distance) {
  const double same = kSameFoot * distance;
  for (int i = 0; i < feet.count; ++i) {
    if ((feet.feet[i].at.position - place.position).squaredNorm() <= same * same) return true;
  }
  return false;
}

void insertLowest(const Foot& foot, Feet& feet) {
  if (feet.count < Feet::kMax) {
    feet.add() = foot;
    return;
  }
  const auto highest = std::max_element(feet.feet.begin(), feet.feet.end(),
                                        [](const Foot& l, const Foot& r) { return l.height < r.height; });
  if (foot.height < highest->height) *highest = foot;
}

/// Adds the foot at a local minimum, unless it is there already or seen from behind.
void addFoot(const Surface& surface, Index triangle, const ClosestOnTriangle& closest, const Vec3& centre, Feet& feet) {
  const SurfacePoint place = placeOf(triangle, closest);
  Foot foot;
  const bool stands =
      !isKnown(feet, place, std::sqrt(closest.squared_distance)) && standsOn(surface, place, centre, foot);
  if (stands) insertLowest(foot, feet);
}

bool isLower(const Surface& surface, Index triangle, const ClosestOnTriangle& closest, const Vec3& centre,
             double height) {
  Foot foot;
  return standsOn(surface, placeOf(triangle, closest), centre, foot) && foot.height < height;
}

/// A local minimum of the distance, found in one triangle.
struct Minimum {
  ClosestOnTriangle closest;
  Index triangle;
};

/// The minima nearer than `reach` in the order in which the tree's search comes to them: the first of those that are
/// one foot names its triangle, and the order of feet is that of the planes that a centre is kept off by. False when
/// they are not known here.
bool minimaNearby(const Surface& surface, const NearbySkin* nearby, const Vec3& centre, double reach,
                  std::array<Minimum, Feet::kMax>& minima, int& count) {
  SkinList list;
  if (!listNearer(nearby, centre, reach, list)) return false;
  const tree::TriangleTree& tree = surface.geometry->tree;
  count = 0;
  for (int i = 0; i < list.count; ++i) {
    const Index t = list.records[i];
    const ClosestOnTriangle closest = tree::closestOnTriangle(tree.records[t].corners, centre);
    if (!(closest.squared_distance < reach * reach) || !isLocalMinimum(surface, t, closest, centre)) continue;
    if (count == Feet::kMax) return false;
    minima[count++] = {closest, t};
  }
  if (count < 2) return true;
  const tree::PointQuery query = tree::detail::pointQuery(tree, centre);
  for (int i = 1; i < count; ++i) {
    const Minimum moved = minima[i];
    int place = i;
    for (; place > 0 && visitedBefore(*nearby, query, moved.triangle, minima[place - 1].triangle); --place) {
      minima[place] = minima[place - 1];
    }
    minima[place] = moved;
  }
  return true;
}

}  // namespace

Feet& Feet::operator=(const Feet& other) {
  if (this == &other) return *this;
  count = 0;
  for (int i = 0; i < other.count; ++i) add() = other.feet[i];
  return *this;
}

int Feet::lowest() const {
  int best = 0;
  for (int i = 1; i < count; ++i) {
    if (feet[i].height < feet[best].height) best = i;
  }
  return best;
}

bool standsOn(const Surface& surface, const SurfacePoint& place, const Vec3& centre, Foot& foot) noexcept {
  const Vec3 to_centre = centre - place.position;
  const double distance = to_centre.norm();
  foot.at = place;
  const bool on_skin = distance <= directionlessDepth(surface);
  if (on_skin || beyondBorder(surface, place, centre) > 0.0) {
    foot.normal = normalAt(surface, place);
    const double above = to_centre.dot(foot.normal);
    foot.height = std::max(above, 0.0);
    return on_skin || above > 0.0;
  }
  foot.normal = to_centre / distance;
  foot.height = distance;
  return isInFront(surface, place, to_centre);
}

void findFeet(const Surface& surface, const Vec3& centre, double reach, Feet& feet, const NearbySkin* nearby) noexcept {
  feet.count = 0;
  std::array<Minimum, Feet::kMax> minima;
  int count = 0;
  if (minimaNearby(surface, nearby, centre, reach, minima, count)) {
    for (int i = 0; i < count; ++i) {
      addFoot(surface, minima[i].triangle, minima[i].closest, centre, feet);
    }
    return;
  }
  const double limit = reach * reach;
  visitNearMinima(surface.geometry->tree, centre, limit, [&](Index triangle, const ClosestOnTriangle& closest) {
    if (isLocalMinimum(surface, triangle, closest, centre)) addFoot(surface, triangle, closest, centre, feet);
    return limit;
  });
}

bool followFoot(const Surface& surface, const Vec3& centre, Foot& foot) noexcept {
  const WalkResult walk = walkToNearest(surface, foot.at, centre, std::numeric_limits<double>::infinity());
  return standsOn(surface, walk.at, centre, foot) && walk.finished;
}

bool hasLowerFoot(const Surface& surface, const Vec3& centre, double height, const NearbySkin* nearby) noexcept {
  SkinList list;
  if (listNearer(nearby, centre, height, list)) return hasLowerFootAmong(surface, list, centre, height);
  bool any = false;
  const double limit = height * height;
  visitNearTriangles(surface.geometry->tree, centre, limit, [&](Index triangle, const ClosestOnTriangle& closest) {
    any = isLower(surface, triangle, closest, centre, height);
    return any ? 0.0 : limit;
  });
  return any;
}

bool hasLowerFootAmong(const Surface& surface, const SkinList& list, const Vec3& centre, double height) noexcept {
  for (int i = 0; i < list.count; ++i) {
    const Index triangle = list.records[i];
    const ClosestOnTriangle closest = tree::closestOnTriangle(surface.geometry->tree.records[triangle].corners, centre);
    if (closest.squared_distance < height * height && isLower(surface, triangle, closest, centre, height)) return true;
  }
  return false;
}

SurfacePoint nearestFront(const Surface& surface, const Vec3& centre, double reach) noexcept {
  const tree::NearestPoint nearest =
      nearestPointIf(surface.geometry->tree, centre, reach, [&](Index triangle, const ClosestOnTriangle& closest) {
        Foot foot;
        return standsOn(surface, placeOf(triangle, closest), centre, foot);
      });
  return placeOf(nearest.triangle, nearest.closest);
}

HalfSpace offsetHalfSpace(const Foot& foot, double radius) noexcept {
  return {foot.normal, foot.normal.dot(foot.at.position) + radius};
}

}  // namespace palpate::contact
