// Friction of the finger on the skin. Comes after the contact solver and before the force in every tick.
//
// The anchor is kept as state and not divided out of a noisy force (E1). The slip flag is kept too: once slipping, the
// limit is the dynamic one until the pull falls below it by itself, so kinetic friction is exactly its coefficient at
// any speed; without the flag the ratio would saw between the two coefficients.
//
// Friction pulls towards a point in space. An anchor that must lie on the skin cannot always lie where the pull ended,
// and the next tick would see another pull: steps of newtons while the tip hardly moves.
//
// Based on: Coulomb's law; Hayward and Armstrong, "A new computational model of friction applied to haptic rendering"
// (2000) for friction by displacement; Ji (2008), 2.2 for the anchor.
#include "palpate/contact/friction.h"

#include <algorithm>
#include <cmath>

#include "palpate/contact/surface_walk.h"

namespace palpate::contact {

namespace {

/// As a multiple of an offset's tangential part: an offset up to 60 degrees off the skin counts whole.
constexpr double kMaxStretch = 2.0;

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

/// The pull without what would lead the whole force into the bank of a crack. In a valley or a wedge the tip lies deep
/// beside its wall, so that the normal hardly leads out of it and friction would win.
Vec3 keptOffBank(const Pressure& press, const Vec3& pull) {
  const double stiffness = press.tangential_n_per_mm;
  const double into_n = -(press.force_n * press.normal + stiffness * pull).dot(press.bank);
  if (!(into_n > 0.0) || !(stiffness > 0.0)) return pull;
  const Vec3 along = press.bank - press.bank.dot(press.normal) * press.normal;
  const double length2 = along.squaredNorm();
  if (!(length2 > 0.0)) return pull;
  return pull + (std::min(into_n / stiffness, std::max(0.0, -pull.dot(along))) / length2) * along;
}

/// Moves the requested pull towards the one that changes the force least, as far as the step needs. That one lies in
/// the friction cone too (`longest_mm`), which takes precedence over the step.
Vec3 withinStep(const Pressure& press, const Vec3& request, double longest_mm, double most_n,
                const Vec3& force_before) {
  const double stiffness = press.tangential_n_per_mm;
  const Vec3 change = press.force_n * press.normal + stiffness * request - force_before;
  const double too_much = change.squaredNorm() - most_n * most_n;
  if (!(too_much > 0.0) || !(stiffness > 0.0)) return request;
  const Vec3 left = force_before / stiffness;
  Vec3 gentlest = left - left.dot(press.normal) * press.normal;
  const double length = gentlest.norm();
  if (length > longest_mm) gentlest *= longest_mm / length;
  // |change + share way| = most_n
  const Vec3 way = stiffness * (gentlest - request);
  const double a = way.squaredNorm();
  const double b = change.dot(way);
  if (!(a > 0.0)) return request;
  const double root2 = b * b - a * too_much;
  const double share = root2 > 0.0 ? (-b - std::sqrt(root2)) / a : -b / a;
  return request + std::clamp(share, 0.0, 1.0) * (gentlest - request);
}

}  // namespace

Grip gripOf(const Vec3& proxy, const Vec3& normal, const Vec3& anchor, const GripLimits& limits,
            bool slipped_before) noexcept {
  const Vec3 offset = anchor - proxy;
  const Vec3 rough = offset - offset.dot(normal) * normal;
  const Vec3 tangential = rough - rough.dot(normal) * normal;  // twice: an offset along the normal leaves rounding
  const double length = tangential.norm();
  // As long as the whole offset: wrapping around a bump does not hide displacement. But never much longer than what is
  // tangential, or an offset that points along the normal would pull in the direction of its rounding.
  const double stretched = std::min(offset.norm(), kMaxStretch * length);
  const bool slips = stretched > (slipped_before ? limits.slipping_mm : limits.sticking_mm);
  const double kept = slips ? limits.slipping_mm : stretched;
  if (length == 0.0 || kept == 0.0) return {Vec3::Zero(), slips};
  return {(kept / length) * tangential, slips};
}

Hold holdOf(const Surface& surface, const Pressure& press, const GripLimits& limits, double most_n,
            FingerState& state) noexcept {
  const Grip grip = gripOf(press.proxy, press.normal, state.hold, limits, state.slipping);
  const Vec3 request = keptOffBank(press, grip.pull);
  const Vec3 pull = withinStep(press, request, limits.sticking_mm, most_n, state.force);
  const bool settled = pull == request;
  state.slipping = grip.slipping;
  if (grip.slipping || pull != grip.pull) state.hold = press.proxy + pull;
  state.anchor = dragged(surface, state, state.hold, (state.hold - press.proxy).norm());
  return {pull, settled};
}

}  // namespace palpate::contact
