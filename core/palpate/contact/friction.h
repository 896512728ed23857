// Coulomb friction with a memory: the anchor that the skin holds while the finger sticks, and drags while it slips.
#pragma once

#include "palpate/base/vec.h"
#include "palpate/contact/finger_state.h"
#include "palpate/contact/surface.h"

namespace palpate::contact {

/// What holds the tip sideways.
struct Grip {
  Vec3 pull = Vec3::Zero();  ///< u, mm, tangential: k_t u is the friction force on the tip
  bool slipping = false;
};

struct GripLimits {
  double sticking_mm = 0.0;  ///< mu_static F_n / k_t
  double slipping_mm = 0.0;  ///< mu_dynamic F_n / k_t
};

/// Pull of an anchor on a tip that presses at `proxy` with unit normal `normal`.
Grip gripOf(const Vec3& proxy, const Vec3& normal, const Vec3& anchor, const GripLimits& limits,
            bool slipped_before) noexcept;

/// How the finger presses, as friction sees it.
struct Pressure {
  Vec3 proxy;
  Vec3 normal;                 ///< unit
  double force_n;              ///< along the normal
  double tangential_n_per_mm;  ///< k_t
};

/// What holds the tip in this tick.
struct Hold {
  Vec3 pull = Vec3::Zero();
  bool settled = true;  ///< false: on its way to the pull of gripOf, which would have been too large a step
};

/// Updates the slip flag, the point in space that holds the finger (FingerState::hold) and the anchor on the skin for
/// this press. The whole force leaves FingerState::force by at most `most_n` as far as the friction cone allows it: the
/// drop of a break-away is spread over ticks, and so is whatever turns the pull round.
Hold holdOf(const Surface& surface, const Pressure& press, const GripLimits& limits, double most_n,
            FingerState& state) noexcept;

// The friction anchor as (2.6) prints it, kept to show what it does.
//
// "A = P - (F_t / F_n) P_d" with every symbol a vector: P_d, from the proxy to the tip, is normal to the skin, so that
// A slides along the normal instead of along the skin, out of the body by depth |F_t| / F_n. The corrected anchor of
// the same force is A = P + (p / F_n) F_t. Based on: Ji, dissertation 2008, (2.5), (2.6); E1.

/// The proxy itself when nothing presses. `normal` is the unit outward normal, `force` what the user feels.
inline Vec3 literalAnchorOfForce(const Vec3& proxy, const Vec3& tip, const Vec3& normal, const Vec3& force) noexcept {
  const double normal_force = force.dot(normal);
  const double depth = (proxy - tip).dot(normal);
  if (!(normal_force > 0.0) || !(depth > 0.0)) return proxy;
  const double tangential_force = (force - normal_force * normal).norm();
  return proxy + depth * tangential_force / normal_force * normal;
}

}  // namespace palpate::contact
