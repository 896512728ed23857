// The winding number names its sources.
#include "palpate/contact/sides.h"

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

/// The way from a place of the skin begins this share of it off the place, so that the place itself is no obstacle.
constexpr double kOffThePlace = 1e-6;

}  // namespace

bool isOutside(const Surface& surface, const Vec3& tip, double lag) noexcept {
  if (!(tree::windingNumber(surface.geometry->tree, tip) < kSurelyOutside)) return false;
  if (surface.geometry->closed) return true;
  const tree::NearestPoint nearest = nearestPoint(surface.geometry->tree, tip, lag);
  if (nearest.triangle == kNoIndex) return false;
  const SurfacePoint place{nearest.closest.point, nearest.triangle, nearest.closest.feature};
  return !onBorder(surface, place) && inFrontOf(surface, place, tip);
}

bool isInAir(const Surface& surface, const Vec3& place, const Vec3& tip) noexcept {
  const Vec3 way = tip - place;
  const double lag = way.norm();
  if (!(kOffThePlace * lag > releaseSlack(surface))) return false;
  const Vec3 begin = place + kOffThePlace * way;
  return tree::firstFrontCrossing(surface.geometry->tree, begin, tip).triangle == kNoIndex &&
         tree::firstFrontCrossing(surface.geometry->tree, tip, begin).triangle == kNoIndex &&
         isOutside(surface, tip, lag);
}

bool isInside(const Surface& surface, const Vec3& tip) noexcept {
  return surface.geometry->closed && tree::windingNumber(surface.geometry->tree, tip) > kInside;
}

bool isBuried(const Surface& surface, const Vec3& place) noexcept {
  return surface.geometry->self_intersecting && surface.geometry->closed &&
         tree::windingNumber(surface.geometry->tree, place) > kSurelyInside;
}

}  // namespace palpate::contact
