// Force and stiffness: the device table of CHAI3D 3.3.0 and, for the Omni, what its driver reports as nominal.
// Inverse3, and everything that is mechanics: assumed.
#include "palpate/device/device_profile.h"

#include <algorithm>
#include <optional>

namespace palpate::device {

namespace {

DeviceProfile tabulatedProfile(scene::DeviceModel model) {
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

/// 0 means unknown.
void lower(double& value, double other) {
  if (other > 0.0) value = value > 0.0 ? std::min(value, other) : other;
}

/// A motion is scaled and a force is not: a spring of the body is `scale` times as stiff in the hand, and the device's
/// mass and damping are smaller in the body accordingly.
DeviceProfile scaleToBody(DeviceProfile profile, double scale) {
  profile.stiffness_n_per_mm /= scale;
  profile.mass_kg /= scale;
  profile.damping_n_s_per_mm /= scale;
  profile.encoder_mm *= scale;
  profile.motion_scale = scale;
  return profile;
}

DeviceProfile weakestProfile(const DeviceProfile& a, const DeviceProfile& b) {
  DeviceProfile least;
  least.known = a.known && b.known;
  least.force_n = std::min(a.force_n, b.force_n);
  least.stiffness_n_per_mm = a.stiffness_n_per_mm;
  lower(least.stiffness_n_per_mm, b.stiffness_n_per_mm);
  // The lightest in the hand, seen at the larger scale: a light device next to a scaled heavy one stays light.
  least.mass_kg =
      std::min(a.mass_kg * a.motion_scale, b.mass_kg * b.motion_scale) / std::max(a.motion_scale, b.motion_scale);
  least.damping_n_s_per_mm = std::min(a.damping_n_s_per_mm, b.damping_n_s_per_mm);
  least.friction_n = std::min(a.friction_n, b.friction_n);
  least.encoder_mm = std::max(a.encoder_mm, b.encoder_mm);
  least.motion_scale = std::max(a.motion_scale, b.motion_scale);
  least.unsafe_force_n = std::min(a.unsafe_force_n, b.unsafe_force_n);
  least.open = a.open || b.open;
  least.delay_ticks = std::max(a.delay_ticks, b.delay_ticks);
  return least;
}

}  // namespace

DeviceProfile profileOf(scene::DeviceModel model) {
  DeviceProfile profile = tabulatedProfile(model);
  if (profile.known) profile.unsafe_force_n = profile.force_n;
  return profile;
}

DeviceProfile profileOf(scene::DeviceModel named, const Capabilities& reported) {
  const bool recognised = reported.kind != scene::DeviceModel::unknown;
  DeviceProfile profile = profileOf(recognised || reported.takes_force ? reported.kind : named);
  if (reported.documented && !recognised) {
    profile.known = true;
    profile.force_n = reported.max_force_n;
  }
  if (reported.max_force_n > 0.0) profile.unsafe_force_n = reported.max_force_n;
  lower(profile.force_n, reported.max_force_n);
  lower(profile.stiffness_n_per_mm, reported.nominal_stiffness_n_per_mm);
  if (!recognised) lower(profile.stiffness_n_per_mm, profileOf(named).stiffness_n_per_mm);
  profile.open = reported.takes_force;
  profile.delay_ticks = reported.takes_force ? reported.delay_ticks : 0.0;
  return scaleToBody(profile, reported.motion_scale);
}

DeviceProfile profileOf(scene::DeviceModel named, std::span<const Capabilities> open) {
  const bool any_force = std::ranges::any_of(open, &Capabilities::takes_force);
  std::optional<DeviceProfile> least;
  for (const Capabilities& device : open) {
    if (any_force && !device.takes_force) continue;
    const DeviceProfile profile = profileOf(named, device);
    least = least ? weakestProfile(*least, profile) : profile;
  }
  return least.value_or(profileOf(named));
}

double largestForceN(const scene::SafetySettings& safety, const DeviceProfile& profile) {
  if (!(safety.nominal_force_n > 0.0)) return profile.force_n;
  return std::min(safety.nominal_force_n, safety.unsafe_stiffness ? profile.unsafe_force_n : profile.force_n);
}

}  // namespace palpate::device
