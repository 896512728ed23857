// Coulomb friction with a memory: the anchor that the skin holds while the finger sticks, and drags while it slips.
#pragma once

#include "palpate/contact/press.h"

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

/// Point finger: updates the anchor and the slip flag in `state` for this press, and returns the pull. While it slips
/// the anchor walks on the skin to where the pull ends.
Vec3 holdOnSkin(const Surface& surface, const Press& press, const GripLimits& limits, FingerState& state) noexcept;

/// Sphere: the same with the anchor as a point in space, FingerState::hold; the anchor on the skin follows it.
Vec3 holdInSpace(const Surface& surface, const Press& press, const GripLimits& limits, FingerState& state) noexcept;

/// The anchor of a force that was measured rather than computed: A = P + (p / F_n) F_t, P when nothing presses.
/// Based on: Ji, dissertation 2008, (2.5) and (2.6) as E1 corrects them.
Vec3 anchorOfForce(const Vec3& proxy, const Vec3& tip, const Vec3& normal, const Vec3& force) noexcept;

}  // namespace palpate::contact
