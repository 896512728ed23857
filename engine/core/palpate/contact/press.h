// How the tip presses the skin in this tick: a finger's contact solver passes it on to friction and force.
#pragma once

#include "palpate/contact/finger_state.h"
#include "palpate/contact/surface.h"

namespace palpate::contact {

struct NearbySkin;

struct Press {
  bool touching = false;
  Vec3 proxy = Vec3::Zero();   ///< P
  Vec3 normal = Vec3::Zero();  ///< n, unit, from the tip towards the skin's outside
  double depth_mm = 0.0;       ///< p, along n
  double felt_depth_mm = 0.0;  ///< p as the force counts it: capped, faded at a border
  std::uint32_t status = 0;
  Vec3 bank = Vec3::Zero();  ///< unit, at the rim of a crack: the skin there, into which friction must not lead
};

/// How far the proxy may move in this tick, mm.
inline double pathBound(const FingerSettings& settings, double tip_moved_mm) {
  return 2.0 * tip_moved_mm + settings.catch_up_mm_per_s * settings.tick_s;
}

/// How far what is felt (the depth along its normal, as a vector) may change in a tick, mm: as far as tip and proxy can
/// move apart.
inline double feltBound(const FingerSettings& settings, double tip_moved_mm) {
  return tip_moved_mm + pathBound(settings, tip_moved_mm);
}

/// Below this depth the direction from tip to proxy is rounding, and the skin's own normal is used.
inline double directionlessDepth(const Surface& surface) { return 1e-11 * surface.geometry->tree.diagonal; }

/// A tip is released only when it is in front of the skin by more than rounding. Otherwise one released "on" the plane
/// would start its next segment behind it and fall through without an event.
inline double releaseSlack(const Surface& surface) { return 1e-12 * surface.geometry->tree.diagonal; }

/// A finger lands at a place: what it slides further within this tick is friction already.
inline void land(const SurfacePoint& at, FingerState& state) {
  state.touching = true;
  state.slipping = false;
  state.proxy = state.anchor = at;
  state.hold = at.position;
}

/// Where a way passes the skin, as a place of it.
inline SurfacePoint placeOf(const tree::Crossing& crossing) {
  return {crossing.point, crossing.triangle, tree::Feature::face};
}

/// Whether the tip is in front of the skin's tangent plane at `place`, by more than rounding.
bool inFrontOf(const Surface& surface, const SurfacePoint& place, const Vec3& tip) noexcept;

/// The press of a tip that is held at `proxy`: along the line between the two, or along the normal of the skin there
/// and of no depth where that line is only rounding.
Press pressTowards(const Surface& surface, const FingerSettings& settings, const Vec3& proxy, const SurfacePoint& skin,
                   const Vec3& tip) noexcept;

// The finger of radius 0: a point whose proxy is the local minimum of the distance on the skin.

/// Moves the proxy in `state` (whose tip is still the last tick's) for a new tip. On first contact the anchor starts
/// where the tip came through the skin. Sets FingerState::guarded where sheets that pierce each other begin.
Press pressPoint(const Surface& surface, const FingerSettings& settings, FingerState& state, const Vec3& tip) noexcept;

/// The same on a surface whose sheets pierce each other: next to where they do the point is a sphere of 1e-4 of the
/// diagonal (0.05 mm on a back). The walk of a point would slide along one sheet into the inside of the other; a sphere
/// asks all of them, and costs more.
Press pressGuardedPoint(const Surface& surface, const FingerSettings& settings, FingerState& state,
                        const Vec3& tip) noexcept;

// The finger with a radius: a sphere that rests on the skin with its centre as near to the tip as it can get.

/// Moves the centre in `state` (whose tip is still the last tick's) for a new tip, for a sphere of `radius` > 0.
/// `nearby`: the skin near it, where a tool has gathered that (nearby_skin.h), or null; it changes nothing but the
/// time.
Press pressSphere(const Surface& surface, const FingerSettings& settings, double radius, FingerState& state,
                  const Vec3& tip, const NearbySkin* nearby = nullptr) noexcept;

}  // namespace palpate::contact
