// The last step of a tick: from how the tip presses the skin to what the finger reports and the force on the tip.
#pragma once

#include "palpate/contact/friction.h"

namespace palpate::contact {

/// False for a tip that is not finite or absurdly far away: a broken device.
bool usableTip(const Surface& surface, const Vec3& tip) noexcept;

/// A tip that touches nothing.
FingerOutput freeOutput(const Vec3& tip) noexcept;

/// The answer to a tip that is not usable: no force, the state as it was.
FingerOutput lostOutput(const FingerState& state) noexcept;

/// How friction holds: holdOnSkin or holdInSpace.
using Hold = Vec3 (*)(const Surface&, const Press&, const GripLimits&, FingerState&) noexcept;

/// Normal force by the surface's force law, friction by `hold`, both together in newton. Moves the anchor in `state`.
FingerOutput pressedOutput(const Surface& surface, const FingerSettings& settings, const Press& press, const Vec3& tip,
                           Hold hold, FingerState& state) noexcept;

}  // namespace palpate::contact
