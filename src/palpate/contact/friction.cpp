// Friction of the finger on the skin. Comes after the contact solver and before the force in every tick.
//
// The anchor is kept as state and not divided out of a noisy force (E1). The slip flag is kept too: once slipping, the
// limit is the dynamic one until the pull falls below it by itself, so kinetic friction is exactly its coefficient at
// any speed; without the flag the ratio would saw between the two coefficients.
//
// Based on: Coulomb's law; Hayward and Armstrong, "A new computational model of friction applied to haptic rendering"
// (2000) for friction by displacement; Ji (2008), 2.2 for the anchor.
#include "palpate/contact/friction.h"

#include <cmath>

#include "palpate/contact/surface_walk.h"

namespace palpate::contact {

namespace {

/// An offset whose tangential share is smaller points along the normal: what is left of it is rounding.
constexpr double kDirectionless = 1e-12;

/// The place of the skin nearest to `target`, found from where the anchor was; from the proxy when the proxy has moved
/// somewhere else (the anchor would be left behind on another part of the skin).
SurfacePoint dragged(const Surface& surface, const FingerState& state, const Vec3& target, double pull_mm) noexcept {
  const double near_enough = 0.5 * pull_mm;
  for (const SurfacePoint& from : {state.anchor, state.proxy}) {
    const WalkResult walk = walkToNearest(surface, from, target, kUnbounded);
    if (walk.finished && (walk.at.position - target).norm() <= near_enough) return walk.at;
  }
  return walkToNearest(surface, state.proxy, target, pull_mm).at;
}

}  // namespace

Grip gripOf(const Vec3& proxy, const Vec3& normal, const Vec3& anchor, const GripLimits& limits,
            bool slipped_before) noexcept {
  const Vec3 offset = anchor - proxy;
  const Vec3 rough = offset - offset.dot(normal) * normal;
  const Vec3 tangential = rough - rough.dot(normal) * normal;  // twice: an offset along the normal leaves rounding
  const double length = tangential.norm();
  // As long as the whole offset: wrapping around a bump does not hide displacement. Unless there is no direction.
  const double whole = offset.norm();
  const double stretched = length > kDirectionless * whole ? whole : 0.0;
  const bool slips = stretched > (slipped_before ? limits.slipping_mm : limits.sticking_mm);
  const double kept = slips ? limits.slipping_mm : stretched;
  if (stretched == 0.0 || kept == 0.0) return {Vec3::Zero(), slips};
  return {(kept / length) * tangential, slips};
}

Vec3 holdOnSkin(const Surface& surface, const Press& press, const GripLimits& limits, FingerState& state) noexcept {
  const Grip grip = gripOf(press.proxy, press.normal, state.anchor.position, limits, state.slipping);
  state.slipping = grip.slipping;
  if (grip.slipping) state.anchor = dragged(surface, state, press.proxy + grip.pull, grip.pull.norm());
  state.hold = state.anchor.position;
  return grip.pull;
}

Vec3 holdInSpace(const Surface& surface, const Press& press, const GripLimits& limits, FingerState& state) noexcept {
  const Grip grip = gripOf(press.proxy, press.normal, state.hold, limits, state.slipping);
  state.slipping = grip.slipping;
  if (grip.slipping) state.hold = press.proxy + grip.pull;
  state.anchor = dragged(surface, state, state.hold, (state.hold - press.proxy).norm());
  return grip.pull;
}

}  // namespace palpate::contact
