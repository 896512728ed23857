// The border of an open sheet: the proxy cannot follow further, so the force fades away.
#pragma once

#include "palpate/contact/finger.h"

namespace palpate::contact {

/// Depth that is still felt when the proxy sits on a border with normal `normal`: the depth below the sheet's plane
/// less the distance beyond the border. 0 or less means let go.
///
/// A force towards the proxy would pull the finger under the sheet, and letting go at once is a step (2.7 N at 200 mm/s
/// and 5 mm depth, against 0.1 N a tick here).
double depthAtBorder(const Vec3& proxy, const Vec3& normal, const Vec3& tip) noexcept;

}  // namespace palpate::contact
