// First contact of a sphere finger.
#pragma once

#include "palpate/contact/finger.h"

namespace palpate::contact {

/// Decides whether a free sphere touches in this tick: when its centre's way crosses the skin, or when it overlaps the
/// front of the skin at the end. If so, starts the contact in `state` with the centre where it first touched; a sphere
/// that overlaps from the beginning starts with its centre at the tip, to be pushed out.
bool landSphere(const Surface& surface, double radius, FingerState& state, const Vec3& tip) noexcept;

}  // namespace palpate::contact
