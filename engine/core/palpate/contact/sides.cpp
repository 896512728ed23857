// The winding number names its sources.
#include "palpate/contact/sides.h"

#include <algorithm>
#include <cmath>

#include "palpate/contact/press.h"
#include "palpate/contact/surface_walk.h"
#include "palpate/tree/triangle_tree.h"

namespace palpate::contact {

namespace {

/// Winding numbers of a closed surface are whole but for 0.05, except on the surface itself, where they are the share
/// of directions that lead inside. In doubt the finger stays held, or is.
constexpr double kSurelyOutside = 0.25;
constexpr double kInside = 0.5;
constexpr double kSurelyInside = 0.9;

/// Far from its borders an open body's winding number is whole but for the solid angle of its openings, as a share of
/// all directions. Above this, of which a third may be the number's own 0.05, it may be the side of a sheet.
constexpr double kSurelyNoSheet = 0.15;

/// The way from a place of the skin begins this share of it off the place, so that the place itself does not block it.
constexpr double kOffThePlace = 1e-6;

/// Inside an open body: the openings take less than a quarter of all directions, and the number may be 0.05 too small.
/// From the plane of an opening on they take a half.
constexpr double kInsideThoughOpen = 0.75 - 0.05;
constexpr double kPastAnOpening = 0.5;

/// Whether the way goes into the skin at a place, at its triangle or one that shares the place's edge or corner: what
/// is between in nearly every tick, without a search of the tree.
bool meetsSkinBeside(const Surface& surface, const SurfacePoint& place, const Vec3& from, const Vec3& to) {
  const auto& records = surface.geometry->tree.records;
  const auto meets = [&](Index t) {
    tree::Crossing crossing;
    return t != kNoIndex && tree::detail::crossingOf(records[t], from, to, crossing);
  };
  if (meets(place.triangle) || std::ranges::any_of(records[place.triangle].neighbours, meets)) return true;
  if (!tree::isCorner(place.feature)) return false;
  bool met = false;
  visitFan(surface, place.triangle, tree::indexOf(place.feature), [&](Index t, int) {
    met = meets(t);
    return !met;
  });
  return met;
}

/// Looks at every triangle within reach: 10 us on a dense mesh.
bool isFarFromBorders(const Surface& surface, const Vec3& tip, double reach) {
  const auto is_border = [&](Index triangle, const tree::ClosestOnTriangle& closest) {
    return onBorder(surface, {closest.point, triangle, closest.feature});
  };
  return nearestPointIf(surface.geometry->tree, tip, reach, is_border).triangle == kNoIndex;
}

}  // namespace

bool isOutside(const Surface& surface, const Vec3& tip, double reach) noexcept {
  const SurfaceGeometry& geometry = *surface.geometry;
  const double turns = tree::windingNumber(geometry.tree, tip);
  if (!(turns < (geometry.closed || geometry.self_intersecting ? kSurelyOutside : kPastAnOpening))) return false;
  if (geometry.closed) return true;
  const tree::NearestPoint nearest = nearestPoint(geometry.tree, tip, (1.0 + kOffThePlace) * reach);
  if (nearest.triangle == kNoIndex) return true;  // afloat beyond a border: the finger stands on nothing
  const SurfacePoint place{nearest.closest.point, nearest.triangle, nearest.closest.feature};
  if (onBorder(surface, place)) return false;
  if (inFrontOf(surface, place, tip)) return true;
  return geometry.self_intersecting && std::abs(turns) < kSurelyNoSheet && isFarFromBorders(surface, tip, reach);
}

bool isInAir(const Surface& surface, const Vec3& place, const Vec3& tip, double reach,
             const SurfacePoint& beside) noexcept {
  const Vec3 way = tip - place;
  if (!(kOffThePlace * way.norm() > releaseSlack(surface))) return false;
  const Vec3 begin = place + kOffThePlace * way;
  return !meetsSkinBeside(surface, beside, begin, tip) &&
         tree::firstFrontCrossing(surface.geometry->tree, begin, tip).triangle == kNoIndex &&
         tree::firstFrontCrossing(surface.geometry->tree, tip, begin).triangle == kNoIndex &&
         isOutside(surface, tip, reach);
}

bool isInside(const Surface& surface, const FingerState& state, const Vec3& held, const Vec3& tip,
              double reach) noexcept {
  if (surface.geometry->closed) return tree::windingNumber(surface.geometry->tree, tip) > kInside;
  return !state.from_inside && tree::windingNumber(surface.geometry->tree, tip) > kInsideThoughOpen &&
         (isFarFromBorders(surface, tip, reach) || isFarFromBorders(surface, held, reach));
}

bool isBuried(const Surface& surface, const Vec3& place) noexcept {
  return surface.geometry->self_intersecting && surface.geometry->closed &&
         tree::windingNumber(surface.geometry->tree, place) > kSurelyInside;
}

bool isPastAnOpening(const Surface& surface, const Vec3& tip) noexcept {
  return !surface.geometry->closed && tree::windingNumber(surface.geometry->tree, tip) > kPastAnOpening;
}

void noteWhereItComesFrom(const Surface& surface, FingerState& state) noexcept {
  if (!surface.geometry->closed) state.from_inside = isPastAnOpening(surface, state.tip);
}

void noteThatItCameOut(const Surface& surface, const Vec3& tip, FingerState& state) noexcept {
  if (state.from_inside) state.from_inside = isPastAnOpening(surface, tip);
}

}  // namespace palpate::contact
