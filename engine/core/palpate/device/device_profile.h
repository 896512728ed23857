// Known or assumed mechanics of a force-feedback device at its tip: its limits, and the forces that it loses.
//
// The limiter takes its bounds from here, the simulated hand (simulated_hand.h) its mechanics. Reports of an open
// device's driver lower them; no claim of a driver, a plugin or a scene raises them.
#pragma once

#include <limits>
#include <span>

#include "palpate/device/device.h"
#include "palpate/scene/safety_settings.h"

namespace palpate::device {

/// Forces and stiffness are what drivers of these devices allow. Mass, damping, friction and encoder step are
/// *assumptions* of the right size: no maker publishes them, and nothing here was measured on a device.
struct DeviceProfile {
  bool known = false;               ///< its type is; else the force is that of the weakest known device
  double force_n = 3.3;             ///< for a moment; the limit of every scene (largestForceN)
  double stiffness_n_per_mm = 0.0;  ///< recommended maximum; 0: unknown
  double mass_kg = 0.045;           ///< felt at the tip
  double damping_n_s_per_mm = 0.0;
  double friction_n = 0.0;
  double encoder_mm = 0.055;  ///< smallest motion that is seen
  double motion_scale = 1.0;  ///< Capabilities::motion_scale; all of the above is as the body sees it
  /// Limit with --unsafe-stiffness: the driver's report, or a known device's force.
  double unsafe_force_n = std::numeric_limits<double>::infinity();
  // Summary of the open devices.
  bool open = false;         ///< at least one accepts forces: a hand may be on it
  double delay_ticks = 0.0;  ///< Capabilities::delay_ticks
};

/// An unknown device has the least force of all, the lightest mass, the coarsest encoder, and swallows nothing.
DeviceProfile profileOf(scene::DeviceModel model);

/// The profile of an open device: of the kind that its driver recognised, else an unknown one, of which `named`, the
/// scene's word, can only lower the stiffness. Force and stiffness that the driver reports lower them likewise. Seen
/// from the body, after scaling of the motion. A device without force feedback is harmless: it has the profile of the
/// named one.
DeviceProfile profileOf(scene::DeviceModel named, const Capabilities& reported);

/// The limits where several devices share a loop: the least of each among those with force feedback. Without devices,
/// the named one's.
DeviceProfile profileOf(scene::DeviceModel named, std::span<const Capabilities> open);

/// The largest force that a scene's settings allow on such a device, N: min(scene's, device's). With --unsafe-stiffness
/// the scene's, but never more than a known device's or a driver's report.
double largestForceN(const scene::SafetySettings& safety, const DeviceProfile& profile);

}  // namespace palpate::device
