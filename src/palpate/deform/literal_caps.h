// The caps as the damaged text can be read: each component for itself, and a negative depth let through.
//
// (4.16) says "d = m if m < d_max" without a lower end, and (4.18) is missing from the text. A cap on the components
// turns a long drag towards a diagonal of the body's axes and lets it reach sqrt(3) times the cap.
// Based on: Ji, dissertation 2008, (4.15) to (4.18); E19.
#pragma once

#include "palpate/base/vec.h"

namespace palpate::deform {

inline double literallyCappedDepth(double depth_mm, double cap_mm) noexcept {
  return depth_mm < cap_mm ? depth_mm : cap_mm;
}

inline Vec3 literallyCappedDrag(const Vec3& drag_mm, double cap_mm) noexcept {
  return drag_mm.cwiseMax(-cap_mm).cwiseMin(cap_mm);
}

/// How long the latter can be.
inline double literalDragReach(double cap_mm) noexcept { return 1.7320508075688772 * cap_mm; }

}  // namespace palpate::deform
