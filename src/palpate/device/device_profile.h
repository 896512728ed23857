// What is known or assumed of a force-feedback device at its tip: what it may be asked for, and what it swallows.
//
// The limiter takes its bounds from here, the simulated hand (simulated_hand.h) its mechanics. A device that is open
// and tells its own limits overrides them.
#pragma once

#include "palpate/device/device.h"
#include "palpate/scene/safety_settings.h"

namespace palpate::device {

/// Forces and stiffness are what drivers of these devices allow. Mass, damping, friction and encoder step are
/// *assumptions* of the right size: no maker publishes them, and nothing here was measured on a device.
struct DeviceProfile {
  bool known = false;               ///< else a scene's own limits hold, whatever they are
  double force_n = 3.3;             ///< held for a moment
  double stiffness_n_per_mm = 0.0;  ///< recommended at most; 0: nobody says
  double mass_kg = 0.045;           ///< felt at the tip
  double damping_n_s_per_mm = 0.0;
  double friction_n = 0.0;
  double encoder_mm = 0.055;  ///< smallest motion that is seen
  double motion_scale = 1.0;  ///< Capabilities::motion_scale; all of the above is as the body sees it
  bool open = false;          ///< at least one takes forces: a hand may be on it
};

/// An unknown device has the least force of all, the lightest mass, the coarsest encoder, and swallows nothing.
DeviceProfile profileOf(scene::DeviceModel model);

/// The profile, of the kind that a driver reports where it knows it, with the force and the stiffness that it reports
/// in place of the table's where they are above 0, and all of it as the body sees a device whose motion is scaled.
DeviceProfile profileOf(scene::DeviceModel model, const Capabilities& reported);

/// The largest force that a scene's settings allow on such a device, N: its own, or less.
double largestForceN(const scene::SafetySettings& safety, const DeviceProfile& profile);

}  // namespace palpate::device
