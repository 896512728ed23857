// Coulomb friction with a memory: the anchor that the skin holds while the finger sticks, and drags while it slips.
#pragma once

#include "palpate/base/vec.h"
#include "palpate/contact/finger_state.h"
#include "palpate/contact/surface.h"

namespace palpate::contact {

/// How the skin holds the tip sideways.
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
  Vec3 bank = Vec3::Zero();    ///< as Press has it
};

/// The tip's hold in this tick.
struct Hold {
  Vec3 pull = Vec3::Zero();
  bool settled = true;  ///< false: on its way to the pull of gripOf, which would have been too large a step
};

/// Updates the slip flag, the point in space that holds the finger (FingerState::hold) and the anchor on the skin for
/// this press. The whole force leaves FingerState::force by at most `most_n` as far as the friction cone allows it: the
/// drop of a break-away is spread over ticks, and so is whatever turns the pull round.
Hold holdOf(const Surface& surface, const Pressure& press, const GripLimits& limits, double most_n,
            FingerState& state) noexcept;

/// The friction anchor that a force leads back to, (2.6): A = P - (F_t / F_n) P_d. The text calls every symbol a
/// vector, which would put A on the normal line; it can be computed with F_t a vector along the skin and with P_d and
/// F_n numbers along the outward unit `normal`. (2.5) takes the force to point at A, which it does where the spring
/// along the skin is as stiff as the one into it; `stiffness_ratio` > 0 is k_t / k_n. A lies in the plane of contact.
/// The proxy itself when nothing presses. Based on: Ji, dissertation 2008, (2.4) to (2.6); E1.
inline Vec3 anchorOfForce(const Vec3& proxy, const Vec3& tip, const Vec3& normal, const Vec3& force,
                          double stiffness_ratio = 1.0) noexcept {
  const double normal_force = force.dot(normal);
  const double depth = (proxy - tip).dot(normal);
  if (!(normal_force > 1e-9 * force.norm()) || !(depth > 0.0) || !(stiffness_ratio > 0.0)) return proxy;
  return proxy + depth / (stiffness_ratio * normal_force) * (force - normal_force * normal);
}

}  // namespace palpate::contact
