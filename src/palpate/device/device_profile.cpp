// Force and stiffness: the device table of CHAI3D 3.3.0 and, for the Omni, what its driver reports as nominal.
// Inverse3, and everything that is mechanics: assumed. Own.
#include "palpate/device/device_profile.h"

#include <algorithm>

namespace palpate::device {

DeviceProfile profileOf(scene::DeviceModel model) {
  using scene::DeviceModel;
  switch (model) {
    case DeviceModel::unknown:
      return {};
    case DeviceModel::omni:
      return {true, 3.3, 0.5, 0.045, 0.2e-3, 0.26, 0.055};
    case DeviceModel::touch:
      return {true, 3.3, 0.4, 0.045, 0.2e-3, 0.26, 0.055};
    case DeviceModel::touch_x:
      return {true, 7.9, 1.0, 0.045, 0.2e-3, 0.06, 0.023};
    case DeviceModel::premium_1_5:
      return {true, 8.5, 0.8, 0.075, 0.2e-3, 0.04, 0.030};
    case DeviceModel::premium_3_0:
      return {true, 22.0, 1.0, 0.159, 0.3e-3, 0.20, 0.020};
    case DeviceModel::falcon:
      return {true, 8.0, 3.0, 0.20, 1.5e-3, 0.5, 0.064};
    case DeviceModel::omega_3:
      return {true, 12.0, 5.0, 0.20, 2.0e-3, 0.3, 0.010};
    case DeviceModel::inverse3:
      return {true, 5.0, 1.0, 0.10, 0.5e-3, 0.15, 0.015};
  }
  return {};
}

namespace {

/// A motion is scaled and a force is not: a spring of the body is `scale` times as stiff in the hand, and what the
/// device has of mass and damping is so much less in the body.
DeviceProfile asTheBodySees(DeviceProfile profile, double scale) {
  profile.stiffness_n_per_mm /= scale;
  profile.mass_kg /= scale;
  profile.damping_n_s_per_mm /= scale;
  profile.encoder_mm *= scale;
  profile.motion_scale = scale;
  return profile;
}

}  // namespace

DeviceProfile profileOf(scene::DeviceModel model, const Capabilities& reported) {
  DeviceProfile profile = profileOf(reported.kind != scene::DeviceModel::unknown ? reported.kind : model);
  if (reported.max_force_n > 0.0) profile.force_n = reported.max_force_n;
  if (reported.nominal_stiffness_n_per_mm > 0.0) profile.stiffness_n_per_mm = reported.nominal_stiffness_n_per_mm;
  profile.known = profile.known || reported.max_force_n > 0.0;
  profile.open = reported.takes_force;
  return asTheBodySees(profile, reported.motion_scale);
}

double largestForceN(const scene::SafetySettings& safety, const DeviceProfile& profile) {
  if (!(safety.nominal_force_n > 0.0)) return profile.force_n;
  return profile.known ? std::min(safety.nominal_force_n, profile.force_n) : safety.nominal_force_n;
}

}  // namespace palpate::device
