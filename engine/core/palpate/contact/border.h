// The border of an open sheet: the proxy cannot follow further, so the force fades away.
#pragma once

#include "palpate/contact/finger.h"
#include "palpate/contact/surface.h"

namespace palpate::contact {

/// How far a point is beyond the border on which `place` lies, along the sheet continued flat, mm. 0 for a place that
/// is on no border and for a point that is level with it or on the sheet's side.
double beyondBorder(const Surface& surface, const SurfacePoint& place, const Vec3& point) noexcept;

/// Depth that is still felt by a tip (a sphere's centre with `radius`) that is `beyond` the border: how deep it is
/// below the sheet, continued flat, less how far it is beyond. 0 or less releases it.
///
/// A force towards the place would pull the finger under the sheet, and letting go at once is a step (2.7 N at 200 mm/s
/// and 5 mm depth, against 0.1 N a tick here).
double depthAtBorder(const Vec3& place, const Vec3& normal, const Vec3& tip, double radius, double beyond) noexcept;

}  // namespace palpate::contact
