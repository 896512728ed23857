// The last thing between a computed force and a hand: what is sent to the device is always finite, bounded and gradual.
//
// Sits in the servo tick after contact::step: tip -> guardTip -> contact -> limitForce -> device. The contact's own
// force is not touched by it; traces hold both. Based on: Hannaford and Ryu, "Time-domain passivity control of haptic
// interfaces", IEEE Trans. Robot. Autom. 18 (2002), for the energy observer; the controller here only cancels push.
#pragma once

#include <cstdint>

#include "palpate/base/vec.h"
#include "palpate/scene/safety_settings.h"

namespace palpate::servo {

/// Bits of a tick's safety status; 0 means the device got the contact's force as it was.
enum SafetyBit : std::uint32_t {
  kTipNotFinite = 1u << 0,    ///< the device gave no number; its last good tip was used
  kTipJumped = 1u << 1,       ///< the tip moved faster than a hand can; the ramp starts again
  kForceNotFinite = 1u << 2,  ///< the computed force was not a number; zero was used
  kRamping = 1u << 3,         ///< forces are growing after a start, jump or stall
  kDamped = 1u << 4,          ///< the passivity controller damped
  kClamped = 1u << 5,         ///< shortened to the nominal force
  kSlewLimited = 1u << 6,     ///< the change of force was limited
  kStalled = 1u << 7,         ///< the loop had stopped for too long; the ramp starts again
};

struct LimiterSettings {
  scene::SafetySettings safety;
  double stiffness_n_per_mm = 0.5;  ///< the stiffest place that can be touched; scales the slew limit
  double tick_s = 0.001;
};

/// What the limiter remembers of one finger; value-initialised = switched on now.
struct LimiterState {
  Vec3 force = Vec3::Zero();   ///< sent in the last tick, N
  Vec3 tip = Vec3::Zero();     ///< last good tip, mm
  Vec3 motion = Vec3::Zero();  ///< of the tip in this tick, mm
  bool has_tip = false;
  double ramp_ticks = 0.0;   ///< since the ramp began
  double energy_n_mm = 0.0;  ///< given by the hand since it touched, minus given back
  std::uint32_t status = 0;  ///< SafetyBits of this tick
};

/// Starts the tick: returns the tip to use and clears the status.
Vec3 guardTip(const LimiterSettings& settings, LimiterState& state, const Vec3& measured) noexcept;

/// Makes forces grow from nothing again; call it between guardTip and limitForce, `why` is added to the status.
void restartRamp(LimiterState& state, SafetyBit why) noexcept;

/// Ends the tick: the force to send, N. Its length is at most nominal_force_n, always.
Vec3 limitForce(const LimiterSettings& settings, LimiterState& state, const Vec3& contact_force) noexcept;

}  // namespace palpate::servo
