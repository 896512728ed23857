// What is recorded of one finger in one tick.
#pragma once

#include <cstdint>

#include "palpate/contact/finger_state.h"

namespace palpate::trace {

/// Plain data: it crosses threads by copy.
struct Sample {
  std::uint64_t tick = 0;
  std::uint32_t finger = 0;  ///< index in the scene's order
  contact::FingerOutput contact;
  Vec3 device_force = Vec3::Zero();  ///< what the limiter let through, N
  std::uint32_t safety = 0;          ///< servo::SafetyBit; 0 = the contact's force went through unchanged
  /// What the loop has given beyond the skin's law and not taken back yet (servo/passivity.h), N mm. Not written.
  double loss_n_mm = 0.0;
};

}  // namespace palpate::trace
