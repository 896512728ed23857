// The last thing between a computed force and a hand: the sent force is finite, bounded, and gives back no more than
// the skin's own law allows.
//
//   pose ─► guardTip ─► contact ─► limitForce ─► device
//
// limitForce, in this order: fault? -> start rule -> one factor for all stiffness -> slope held at the cap, soft toe ->
// passivity -> clamp -> rate guard. Any fault ends the force in the same tick. The contact's own force is not touched;
// traces hold both.
// docs/explanation/safety.md has the promises and the measurements.
#pragma once

#include <array>
#include <cstdint>

#include "palpate/base/vec.h"
#include "palpate/contact/finger_state.h"
#include "palpate/scene/safety_settings.h"
#include "palpate/servo/passivity.h"
#include "palpate/servo/soft_contact.h"
#include "palpate/tissue/force_law.h"

namespace palpate::servo {

/// Bits of a tick's safety status; 0 means the device got the contact's force, times the one factor, as it was.
enum SafetyBit : std::uint32_t {
  kTipNotFinite = 1u << 0,    ///< the device gave no number; its last good tip was used
  kTipJumped = 1u << 1,       ///< the tip moved farther than a hand can
  kForceNotFinite = 1u << 2,  ///< the computed force was not a number
  kRamping = 1u << 3,         ///< a force that grows after a start inside
  kDamped = 1u << 4,          ///< the passivity controller acted
  kClamped = 1u << 5,         ///< shortened to the largest force
  kForceJumped = 1u << 6,     ///< the force would have grown too fast (up to version 0.2: its change was limited)
  kStalled = 1u << 7,         ///< the loop had stopped for too long
  kTipStale = 1u << 8,        ///< the pose was too old
  kHeldBack = 1u << 9,        ///< no force: the tip has not been outside since the start or the last fault
  kSoftened = 1u << 10,       ///< the soft toe of a fast first touch
  kEmergencyStop = 1u << 11,  ///< latched until it is released
  kTooStiff = 1u << 12,  ///< a warning: in a third of all ticks of contact the controller takes a tenth of the force
  kClutched = 1u << 13,  ///< the device is moved apart from its finger (device/workspace.h)
};

/// Number of different bits.
inline constexpr std::size_t kSafetyBits = 14;

/// The bits that mean: no force in this tick, and the start rule again.
inline constexpr std::uint32_t kFaultBits =
    kTipNotFinite | kTipJumped | kForceNotFinite | kForceJumped | kStalled | kTipStale | kEmergencyStop | kClutched;

struct LimiterSettings {
  bool limited = true;              ///< false: the contact's force as it is, for what pushes no hand
  bool unsafe = false;              ///< allowed by --unsafe-stiffness; reported, not used
  double force_n = 3.3;             ///< the largest
  double stiffness_factor = 1.0;    ///< on all forces: up to compared_n no place is stiffer than the device can render
  double cap_n_per_mm = 0.0;        ///< no force of layered tissue, after that factor, grows faster; 0: none would
  double compared_n = 0.0;          ///< the felt force up to which all places keep their ratios; force_n without a cap
  double stiffness_n_per_mm = 0.5;  ///< the greatest tangent stiffness that is rendered, over that factor
  double steepest = 1.0;            ///< greatest slope of the force law over that of a light touch
  double tick_s = 0.001;
  bool soft_contact = true;
  scene::StartRule start = scene::StartRule::outside;
  double ramp_s = 0.5;
  double max_age_ticks = 2.0;
  double max_jump_mm = 10.0;
  double max_tip_speed_mm_per_s = 3000.0;
  double max_force_rate_n_per_ms = 6.0;
  PassivitySettings passivity;
};

/// Where a device is, and since when.
struct Pose {
  Vec3 tip = Vec3::Zero();  ///< mm
  std::uint64_t tick = 0;   ///< loop's tick: ticks that were missed count
  double age_ticks = 0.0;   ///< since it was measured
};

/// Limiter's memory of one finger; value-initialised = switched on now.
struct LimiterState {
  Vec3 force = Vec3::Zero();   ///< sent in the last tick, N
  Vec3 tip = Vec3::Zero();     ///< last good tip, mm
  Vec3 motion = Vec3::Zero();  ///< motion of the tip in this tick, mm
  bool has_tip = false;
  std::uint64_t tick = 0;      ///< tick of the last good tip
  double elapsed_ticks = 1.0;  ///< between the last two
  bool armed = false;          ///< it has been outside, or its ramp has ended
  double ramp_ticks = 0.0;
  /// Set for devices that take forces. A path that nothing pushes back on closes no loop: there is nothing to damp.
  bool closes_loop = true;
  SoftContact soft;
  PassivityState passivity;
  // For kTooStiff: ticks of contact, and those in which the controller acted, of a second.
  std::uint32_t contact_ticks = 0;
  std::uint32_t damped_ticks = 0;
  std::uint32_t status = 0;                         ///< SafetyBits of this tick
  std::array<std::uint64_t, kSafetyBits> counts{};  ///< ticks in which each bit was set
};

/// Starts the tick: returns the tip to use and clears the status.
Vec3 guardTip(const LimiterSettings& settings, LimiterState& state, const Pose& pose) noexcept;

/// Makes this tick one without force, and the start rule hold again; between guardTip and limitForce.
void reportFault(LimiterState& state, SafetyBit why) noexcept;

/// Ends the tick: the force to send, N. Its length is at most settings.force_n, always.
Vec3 limitForce(const LimiterSettings& settings, LimiterState& state, const contact::FingerOutput& contact,
                const tissue::ForceLaw& law) noexcept;

/// "tip not finite" and so on, for people; in the order of the bits.
const std::array<const char*, kSafetyBits>& safetyNames() noexcept;

}  // namespace palpate::servo
