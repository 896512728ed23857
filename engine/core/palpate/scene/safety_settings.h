// Limits on what a haptic device may do to a hand. Set by the scene, completed by what is known of the device
// (device/device_profile.h), enforced by the servo (servo/limiter.h). docs/explanation/safety.md.
#pragma once

#include <cstdint>

namespace palpate::scene {

/// Devices whose limits are known.
enum class DeviceModel : std::uint8_t {
  unknown,
  omni,
  touch,
  touch_x,
  premium_1_5,
  premium_3_0,
  falcon,
  omega_3,
  inverse3
};

/// The force of a surface that already encloses the tip when a session starts, or resumes after a fault.
enum class StartRule : std::uint8_t {
  outside,  ///< nothing until the tip has been outside once
  ramp,     ///< a force that grows over `ramp_s`
};

struct SafetySettings {
  /// Assumed for a device that does not report its model, and without a device.
  DeviceModel device = DeviceModel::unknown;
  /// Largest force sent to the device, N, never above what the device holds for a moment. 0: that.
  double nominal_force_n = 0.0;
  /// The stiffest that a hand may feel anywhere, N/mm, never above the device's own. 0: that, and what the delay
  /// allows.
  double stiffness_cap_n_per_mm = 0.0;
  /// From sampling the pose to the force taking effect, in ticks, the amplifier's lag included.
  double delay_ticks = 1.0;
  // As measured on this very device; 0: the profile's assumptions, which are trusted less.
  double device_damping_n_s_per_mm = 0.0;
  double device_friction_n = 0.0;
  /// The controller that takes away what the sampled loop gives beyond the skin's own law.
  bool passivity = true;
  /// A fast first touch meets a toe of the force law, so that its first tick stays below half a newton.
  bool soft_contact = true;
  StartRule start = StartRule::outside;
  double ramp_s = 0.5;
  // A tick beyond these is a fault: no force in that tick, and the start rule again.
  double max_age_ticks = 2.0;              ///< of a pose
  double max_jump_mm = 10.0;               ///< of the tip in a tick ...
  double max_tip_speed_mm_per_s = 3000.0;  ///< ... and as a speed, where ticks were missed
  double max_force_rate_n_per_ms = 6.0;    ///< of a growing force
  // For the limiter of versions up to 0.2: read, without effect, and mentioned in a note.
  double slew_per_motion = 2.0;
  double slew_mm = 0.1;
  double passivity_allowance_n_mm = 1.0;
  /// --unsafe-stiffness of the command line: what is asked for holds beyond what the device is trusted with. Never a
  /// key: no scene file sets it, none keeps it.
  bool unsafe_stiffness = false;
};

}  // namespace palpate::scene
