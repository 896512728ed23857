// The record of one finger in one tick.
#pragma once

#include <cstdint>

#include "palpate/contact/finger_state.h"

namespace palpate::trace {

/// The state that a finger had lost when the tick began.
enum ForgetBit : std::uint32_t {
  kForgotTouch = 1u << 0,    ///< it was put elsewhere: what it touched
  kForgotLimiter = 1u << 1,  ///< another device holds it: what the limiter knew
};

/// Plain data: it crosses threads by copy.
struct Sample {
  std::uint64_t tick = 0;
  std::uint32_t finger = 0;  ///< index in the scene's order
  contact::FingerOutput contact;
  Vec3 device_force = Vec3::Zero();  ///< what the limiter let through, N
  std::uint32_t safety = 0;          ///< servo::SafetyBit; 0 = the contact's force went through unchanged
  /// Energy that the loop gave beyond the skin's law and has not taken back yet (servo/limiter.h), N mm. Not in tables.
  double loss_n_mm = 0.0;
  std::uint32_t world = 0;    ///< counts the worlds of a run: which one was felt
  std::uint32_t forgot = 0;   ///< ForgetBits
  std::uint32_t buttons = 0;  ///< of the device, bit 0 the first
};

}  // namespace palpate::trace
