// Moves a sphere's centre over the skin towards the tip.
//
// Every place the centre takes fits (nowhere nearer to the skin than the radius), every one is nearer to the tip than
// the one before, the straight way between two of them crosses no skin, and all together they stay within the path
// bound. So the sphere cannot fall through and cannot swing, whatever happens: when the rounds are used up, the centre
// is still at a good place and the next tick continues from there.
#pragma once

#include "palpate/contact/finger_state.h"
#include "palpate/contact/nearby_skin.h"
#include "palpate/contact/surface.h"

namespace palpate::contact {

/// Constant during one tick.
struct SphereTask {
  const Surface& surface;
  double radius;
  Vec3 tip;
  Vec3 start;         ///< the centre when the tick began
  double path;        ///< how far from `start` the centre may go, mm
  SurfacePoint last;  ///< where the sphere stood on the skin in the last tick
  const NearbySkin* nearby = nullptr;
};

/// Shares of the radius.
/// A sphere fits while it sinks in less than this: 2.4 um of an 8 mm fingertip, 1.2 mN on a back. On a dense mesh the
/// facets under a sphere differ by about as much (sagitta of an edge: 4 um at 0.5 mm), and a sphere that minds them
/// all tries every step twice.
inline constexpr double kFit = 3e-4;
inline constexpr double kTight = 1e-5;  ///< what is asked of a place found directly, so that descent starts with room

/// Whether the way of the centre crosses no skin.
bool isFreeWay(const SphereTask& task, const Vec3& from, const Vec3& to) noexcept;

/// Moves a centre that does not fit straight out of the skin, within the path. True when it fits in the end.
bool pushOut(const SphereTask& task, Vec3& centre) noexcept;

/// Brings a centre that fits as near to the tip as the path and the rounds allow. True when it ends at a local minimum.
/// `foot` becomes the lowest foot there, or the place of a border whose sheet goes on flat under it; it is left alone
/// when the sphere ends in the air. `standing` are the feet at the centre, where they are known, and then those at the
/// place where it ends.
bool descend(const SphereTask& task, Vec3& centre, SurfacePoint& foot, StandingPlaces& standing) noexcept;

}  // namespace palpate::contact
