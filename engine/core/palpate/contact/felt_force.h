// The last step of a tick: from how the tip presses the skin to what the finger reports and the force on the tip, with
// what a press that is held loses of it.
#pragma once

#include "palpate/contact/finger_state.h"
#include "palpate/contact/press.h"
#include "palpate/contact/surface.h"

namespace palpate::contact {

struct LumpPlaces;

/// False for a tip that is not finite or absurdly far away: a broken device.
bool usableTip(const Surface& surface, const Vec3& tip) noexcept;

/// A tip that touches nothing.
FingerOutput freeOutput(const Vec3& tip) noexcept;

/// The answer to a tip that is not usable: no force, the state as it was.
FingerOutput lostOutput(const FingerState& state) noexcept;

/// Output of a finger that moved by `tip_moved_mm` to `tip` and presses like this: normal force by the surface's force
/// law and friction, together in newton. Moves the anchor in `state`. No tick changes the force by more than stiffness
/// times feltBound: a press that has ended at once (the tip came out on another side) fades. What lumps add comes on
/// top and is as steep as they are (tissue::LumpEnergy::steepest). `lumps`: where they lie, or null.
FingerOutput feltOutput(const Surface& surface, const FingerSettings& settings, Press press, const Vec3& tip,
                        double tip_moved_mm, FingerState& state, const LumpPlaces* lumps = nullptr) noexcept;

}  // namespace palpate::contact
