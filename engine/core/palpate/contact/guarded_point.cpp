// A point finger on a surface whose sheets pierce each other: a point where there is one sheet, a very small sphere
// where there are more (Surface::entangled), with the hand-over between the two.
//
// The walk of a point stops where the entangled triangles begin, so it cannot slide through another sheet; from there
// the sphere goes on, and where the sphere stands on a triangle that is not entangled the point goes on again. The two
// differ by the sphere's radius, a force of 0.025 N on a back, which feltOutput spreads.
#include "palpate/contact/press.h"
#include "palpate/contact/sides.h"
#include "palpate/contact/surface_walk.h"

namespace palpate::contact {

namespace {

double smallRadius(const Surface& surface) { return 1e-4 * surface.geometry->tree.diagonal; }

/// Off the skin a sphere counts as standing on it up to here, of its radius.
constexpr double kStanding = 1.5;

/// Whether a tip that passes the skin is the small sphere's from the beginning: the place is entangled, or inside the
/// body from which it has not come out yet, where the sphere finds the way out if there was one.
bool landsAsSphere(const Surface& surface, const tree::Crossing& entry, bool from_inside) {
  if (surface.geometry->entangled[entry.triangle] != 0) return true;
  if (!from_inside) return false;
  const Vec3 normal = normalAt(surface, {entry.point, entry.triangle, tree::Feature::face});
  return isBuried(surface, entry.point + 0.01 * smallRadius(surface) * normal);
}

/// The sphere over the place where the point stopped, or on it where another sheet is too near.
void becomeSphere(const Surface& surface, FingerState& state) {
  const SurfacePoint& place = state.proxy;
  const Vec3 above = place.position + smallRadius(surface) * normalAt(surface, place);
  const auto other_sheet = firstFrontCrossingIf(surface.geometry->tree, place.position, above,
                                                [&](Index t) { return !hasFeatureAt(surface, t, place); });
  state.centre = other_sheet.triangle == kNoIndex ? above : place.position;
  state.fits = false;  // to be seen
}

bool standsClear(const Surface& surface, const FingerState& state) {
  return state.fits && surface.geometry->entangled[state.proxy.triangle] == 0 &&
         (state.centre - state.proxy.position).norm() <= kStanding * smallRadius(surface);
}

}  // namespace

Press pressGuardedPoint(const Surface& surface, const FingerSettings& settings, FingerState& state,
                        const Vec3& tip) noexcept {
  if (!state.touching) {
    const tree::Crossing entry = tree::firstFrontCrossing(surface.geometry->tree, state.tip, tip);
    if (entry.triangle == kNoIndex) return {};
    state.guarded = landsAsSphere(surface, entry, state.from_inside);
  }
  if (!state.guarded) {
    const Press press = pressPoint(surface, settings, state, tip);
    if (state.touching && state.guarded) becomeSphere(surface, state);
    return press;
  }
  const Press press = pressSphere(surface, settings, smallRadius(surface), state, tip);
  if (state.touching && standsClear(surface, state)) state.guarded = false;
  return press;
}

}  // namespace palpate::contact
