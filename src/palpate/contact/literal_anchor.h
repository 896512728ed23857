// The friction anchor as (2.6) prints it, kept to show what it does.
//
// "A = P - (F_t / F_n) P_d" with every symbol a vector: P_d, from the proxy to the tip, is normal to the skin, so that
// A slides along the normal instead of along the skin, out of the body by depth |F_t| / F_n. The corrected anchor of
// the same force is anchorOfForce (friction.h). Based on: Ji, dissertation 2008, (2.5), (2.6); E1.
#pragma once

#include "palpate/base/vec.h"

namespace palpate::contact {

/// The proxy itself when nothing presses. `normal` is the unit outward normal, `force` what the user feels.
inline Vec3 literalAnchorOfForce(const Vec3& proxy, const Vec3& tip, const Vec3& normal, const Vec3& force) noexcept {
  const double normal_force = force.dot(normal);
  const double depth = (proxy - tip).dot(normal);
  if (!(normal_force > 0.0) || !(depth > 0.0)) return proxy;
  const double tangential_force = (force - normal_force * normal).norm();
  return proxy + depth * tangential_force / normal_force * normal;
}

}  // namespace palpate::contact
