// When and where a free sphere first touches.
//
// Based on: Mirtich, "Impulse-based dynamic simulation of rigid body systems" (1996) for conservative advancement.
#include "palpate/contact/sphere_landing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "palpate/contact/border.h"
#include "palpate/contact/sphere_feet.h"
#include "palpate/contact/surface_walk.h"

namespace palpate::contact {

namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
constexpr int kMostAdvances = 32;
/// Nearer to the skin than this share of the radius the advance has arrived.
constexpr double kArrived = 1e-5;

/// Whether the skin lies between the centre and the foot. From inside a body the fronts of other parts may be near, but
/// only through the body.
bool isHidden(const Surface& surface, const SurfacePoint& foot, const Vec3& centre) {
  return firstFrontCrossingIf(surface.tree, foot.position, centre, [&](Index t) {
           return !touchesFeature(surface, t, foot);
         }).triangle != kNoIndex;
}

/// Whether a place in front of one sheet is inside a body: sheets that pierce each other are buried in part, and a tip
/// that starts a session inside must not be held by them.
bool isBuried(const Surface& surface, const Vec3& place) {
  return surface.self_intersecting && surface.closed && windingNumber(surface.tree, place) > 0;
}

bool overlapsFront(const Surface& surface, const Vec3& centre, double radius) {
  Feet feet;
  findFeet(surface, centre, radius, feet);
  for (int i = 0; i < feet.count; ++i) {
    const Foot& foot = feet.feet[i];
    // From beyond a border the sheet is not felt: passing beside it must not catch.
    const bool felt = beyondBorder(surface, foot.at, centre) == 0.0;
    if (felt && !isHidden(surface, foot.at, centre)) return true;
  }
  return false;
}

/// Where a sphere that moves from `from` to `to` first touches: steps as long as the distance to the skin allows.
Vec3 advance(const Surface& surface, const Vec3& from, const Vec3& to, double radius) {
  Vec3 centre = from;
  for (int i = 0; i < kMostAdvances; ++i) {
    const double left = (to - centre).norm();
    if (left == 0.0) break;
    const SurfacePoint front = nearestFront(surface, centre, radius + left);
    if (front.triangle == kNoIndex) break;
    const double room = (front.position - centre).norm() - radius;
    if (room <= kArrived * radius) break;
    centre += std::min(1.0, room / left) * (to - centre);
  }
  return centre;
}

}  // namespace

bool landSphere(const Surface& surface, double radius, FingerState& state, const Vec3& tip) noexcept {
  const partition::Crossing entry = firstFrontCrossing(surface.tree, state.tip, tip);
  const bool enters = entry.triangle != kNoIndex;
  if (!enters && !overlapsFront(surface, tip, radius)) return false;
  // A tip that was inside comes out first: then the contact starts where it is out.
  const partition::Crossing exit = firstFrontCrossing(surface.tree, enters ? entry.point : tip, state.tip);
  const Vec3 outside = exit.triangle == kNoIndex ? state.tip : (enters ? exit.point : tip);
  const Vec3 centre = advance(surface, outside, tip, radius);
  const SurfacePoint foot = nearestFront(surface, centre, kUnbounded);
  if (foot.triangle == kNoIndex || isBuried(surface, centre)) return false;
  state.touching = true;
  state.slipping = false;
  state.fits = false;  // to be seen
  state.centre = centre;
  state.proxy = state.anchor = foot;
  state.hold = foot.position;
  return true;
}

}  // namespace palpate::contact
