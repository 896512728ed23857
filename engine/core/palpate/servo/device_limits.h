// Stiffness and force limits: from a scene's safety settings and the device's properties to the limiter's settings.
//
// One factor softens the whole scene where, up to the force at which people compare, its stiffest place is more than
// device, rate and delay can render at rest. One for all, so that the ratio of two places, which is what a palpating
// finger compares, stays as it is. Above that force a place's own slope is held at the cap: a law that is steep only
// deep inside would else take most of the force from a light touch, too.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "palpate/device/device_profile.h"
#include "palpate/scene/world.h"
#include "palpate/servo/limiter.h"

namespace palpate::servo {

/// The stiffness, N/mm in the hand, that loop and hand were found to keep at rest and no tap to take energy from, by
/// the rate, the whole delay from sampling the pose to the force, and the device's mass. 0: none was. `palpate study
/// stability --map`, docs/explanation/safety.md.
double stableStiffness(double tick_s, double delay_ticks, const device::DeviceProfile& profile);

/// Returns why such a device must not push a hand at this rate and delay, one line; empty: it may.
std::string refusalReason(const device::DeviceProfile& profile, double tick_s, double delay_ticks);

/// Throws Error with that reason where a hand may be on the device: before its forces are switched on.
void requireStable(const device::DeviceProfile& profile, const scene::SafetySettings& safety, double tick_s);

/// Where nothing is stable: what paths from files, which close no loop, are scaled to, N/mm.
inline constexpr double kSoftestCap = 0.05;

/// A scene's safety settings as they hold on that device: the scene's are requests, the device's needs a hard minimum.
/// The delay is at least what its back end knows of. Where a hand may be on the device, passivity and soft contact stay
/// on and guards within kLoosestGuard of their defaults; --unsafe-stiffness gives up the first two.
scene::SafetySettings effectiveSafety(const scene::SafetySettings& asked, const device::DeviceProfile& profile);

/// Largest factor on the default of a guard of [safety] (max_age_ticks, max_jump_mm, ...) may be on a device.
inline constexpr double kLoosestGuard = 4.0;
/// Shortest start = "ramp" on a device, s.
inline constexpr double kQuickestRampS = 0.1;

/// The stiffest that this scene lets a hand feel on that device, N/mm: min(request, the stiffest that device, rate and
/// delay keep at rest). With --unsafe-stiffness, the request.
double stiffnessCap(const scene::SafetySettings& safety, const device::DeviceProfile& profile, double tick_s);

/// At least up to this felt force all places keep their ratios, N: a choice within light palpation, which every known
/// device can hold for long or nearly (docs/explanation/servo.md).
inline constexpr double kComparedForceN = 1.0;

/// The factor on all forces that keeps the steepest part of the force law, up to this force, within the cap: in (0, 1].
/// `stiffness` is that of the stiffest place, `most_mm` the greatest depth.
double stiffnessFactor(const tissue::ForceLaw& law, double stiffness_n_per_mm, double most_mm, double force_n,
                       double cap_n_per_mm);

/// Start of the note on what --unsafe-stiffness lifts.
inline constexpr std::string_view kUnsafeMark = "UNSAFE";

/// A line for each setting that the scene does not get on that device, one for what --unsafe-stiffness lifts and one
/// for what only holds if the scene's measurements are of this device. Empty for most scenes.
std::vector<std::string> safetyNotes(const scene::SafetySettings& asked, const device::DeviceProfile& profile,
                                     double tick_s);

/// The limits for a device, whatever the scene: its stiffness factor is 1. An open device that is refused
/// (refusalReason) gets no force.
LimiterSettings limiterSettings(const scene::SafetySettings& safety, const device::DeviceProfile& profile,
                                double tick_s);

/// The same with the factor that this world's scene needs. `tick_s` is the loop's, which another scene may have begun;
/// 0: the scene's.
LimiterSettings limiterSettings(const scene::World& world, const device::DeviceProfile& profile, double tick_s = 0.0);

/// For a device of the kind that the scene names.
LimiterSettings limiterSettings(const scene::World& world);

}  // namespace palpate::servo
