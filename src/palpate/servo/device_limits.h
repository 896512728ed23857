// How stiff, how strong: from a scene's safety settings and what is known of the device to the limiter's settings.
//
// One factor softens the whole scene where its stiffest place is more than device, rate and delay can render at rest.
// One for all, so that the ratio of two places, which is what a palpating finger compares, stays as it is.
#pragma once

#include <string>

#include "palpate/device/device_profile.h"
#include "palpate/scene/world.h"
#include "palpate/servo/limiter.h"

namespace palpate::servo {

/// What loop and hand were found to keep at rest and no tap to take energy from, N/mm in the hand: by the rate, the
/// whole delay from sampling the pose to the force, and the mass of the device. 0: no stiffness was. `palpate study
/// stability --map`, docs/stability.md.
double stableStiffness(double tick_s, double delay_ticks, const device::DeviceProfile& profile);

/// Why such a device must not push a hand at this rate and delay, one line; empty: it may.
std::string whyRefused(const device::DeviceProfile& profile, double tick_s, double delay_ticks);

/// Throws Error with that reason where a hand may be on the device: before its forces are switched on.
void requireStable(const device::DeviceProfile& profile, const scene::SafetySettings& safety, double tick_s);

/// Where nothing is stable: what paths from files, which close no loop, are scaled to, N/mm.
inline constexpr double kSoftestCap = 0.05;

/// The stiffest that this scene lets a hand feel on that device, N/mm.
double stiffnessCap(const scene::SafetySettings& safety, const device::DeviceProfile& profile, double tick_s);

/// The factor on all forces that keeps the steepest part of the force law, up to the largest force, within the cap: in
/// (0, 1]. `stiffness` is that of the stiffest place, `most_mm` the greatest depth.
double stiffnessFactor(const tissue::ForceLaw& law, double stiffness_n_per_mm, double most_mm, double force_n,
                       double cap_n_per_mm);

/// The limits for a device, whatever the scene: its stiffness factor is 1. An open device that is refused (whyRefused)
/// gets no force.
LimiterSettings limiterSettings(const scene::SafetySettings& safety, const device::DeviceProfile& profile,
                                double tick_s);

/// The same with the factor that this world's scene needs.
LimiterSettings limiterSettings(const scene::World& world, const device::DeviceProfile& profile);

/// For a device of the kind that the scene names.
LimiterSettings limiterSettings(const scene::World& world);

}  // namespace palpate::servo
