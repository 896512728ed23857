// The border of an open sheet: the proxy cannot follow further, so the force fades away.
#pragma once

#include "palpate/base/vec.h"

namespace palpate::contact {

/// Depth that is still felt by a tip (a sphere's centre with `radius`) whose place on the skin is `place` on a border
/// with unit normal `normal`: how deep it is below the sheet, continued flat, less how far it is beyond the border. 0
/// or less means let go.
///
/// A force towards the place would pull the finger under the sheet, and letting go at once is a step (2.7 N at 200 mm/s
/// and 5 mm depth, against 0.1 N a tick here).
double depthAtBorder(const Vec3& place, const Vec3& normal, const Vec3& tip, double radius = 0.0) noexcept;

}  // namespace palpate::contact
