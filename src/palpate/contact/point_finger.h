// The finger of radius 0: a point whose proxy is the local minimum of the distance on the skin.
#pragma once

#include "palpate/contact/press.h"

namespace palpate::contact {

/// Moves the proxy in `state` (whose tip is still the last tick's) for a new tip. On first contact the anchor starts
/// where the tip came through the skin.
Press pressPoint(const Surface& surface, const FingerSettings& settings, FingerState& state, const Vec3& tip) noexcept;

}  // namespace palpate::contact
