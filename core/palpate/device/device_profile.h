// What is known or assumed of a force-feedback device at its tip: what it may be asked for, and what it swallows.
//
// The limiter takes its bounds from here, the simulated hand (simulated_hand.h) its mechanics. What a driver reports of
// an open device lowers them; nothing that a driver, a plugin or a scene claims raises them.
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
  double force_n = 3.3;             ///< held for a moment; no scene asks for more (largestForceN)
  double stiffness_n_per_mm = 0.0;  ///< recommended at most; 0: nobody says
  double mass_kg = 0.045;           ///< felt at the tip
  double damping_n_s_per_mm = 0.0;
  double friction_n = 0.0;
  double encoder_mm = 0.055;  ///< smallest motion that is seen
  double motion_scale = 1.0;  ///< Capabilities::motion_scale; all of the above is as the body sees it
  /// With --unsafe-stiffness no scene asks for more: what a driver reports, or a known device holds.
  double unsafe_force_n = std::numeric_limits<double>::infinity();
  // Of devices that are open.
  bool open = false;         ///< at least one takes forces: a hand may be on it
  double delay_ticks = 0.0;  ///< Capabilities::delay_ticks
};

/// An unknown device has the least force of all, the lightest mass, the coarsest encoder, and swallows nothing.
DeviceProfile profileOf(scene::DeviceModel model);

/// The profile of an open device: of the kind that its driver recognised, else an unknown one, of which `named`, the
/// scene's word, can only lower the stiffness. Force and stiffness that the driver reports lower them likewise. All of
/// it as the body sees a device whose motion is scaled. A device that takes no force pushes nobody: it has the profile
/// of the named one.
DeviceProfile profileOf(scene::DeviceModel named, const Capabilities& reported);

/// What holds where several devices share a loop: the least of every limit of those that take forces. Without devices,
/// the named one's.
DeviceProfile profileOf(scene::DeviceModel named, std::span<const Capabilities> open);

/// The largest force that a scene's settings allow on such a device, N: min(asked, the device's). With
/// --unsafe-stiffness what is asked, but never more than a known device holds or a driver reports.
double largestForceN(const scene::SafetySettings& safety, const DeviceProfile& profile);

}  // namespace palpate::device
