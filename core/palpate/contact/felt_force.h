// The last step of a tick: from how the tip presses the skin to what the finger reports and the force on the tip.
#pragma once

#include "palpate/contact/press.h"

namespace palpate::contact {

/// False for a tip that is not finite or absurdly far away: a broken device.
bool usableTip(const Surface& surface, const Vec3& tip) noexcept;

/// A tip that touches nothing.
FingerOutput freeOutput(const Vec3& tip) noexcept;

/// The answer to a tip that is not usable: no force, the state as it was.
FingerOutput lostOutput(const FingerState& state) noexcept;

/// What a finger that moved by `tip_moved_mm` to `tip` and presses so reports: normal force by the surface's force law
/// and friction, together in newton. Moves the anchor in `state`. No tick changes the force by more than stiffness
/// times feltBound: a press that has ended at once (the tip came out on another side) fades.
FingerOutput feltOutput(const Surface& surface, const FingerSettings& settings, Press press, const Vec3& tip,
                        double tip_moved_mm, FingerState& state) noexcept;

}  // namespace palpate::contact
