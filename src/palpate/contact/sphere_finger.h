// The finger with a radius: a sphere that rests on the skin with its centre as near to the tip as it can get.
#pragma once

#include "palpate/contact/press.h"

namespace palpate::contact {

/// Moves the centre in `state` (whose tip is still the last tick's) for a new tip, for a sphere of `radius` > 0.
Press pressSphere(const Surface& surface, const FingerSettings& settings, double radius, FingerState& state,
                  const Vec3& tip) noexcept;

}  // namespace palpate::contact
