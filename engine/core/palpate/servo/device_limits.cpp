// Load time.
#include "palpate/servo/device_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/contact/surface_walk.h"
#include "palpate/scene/lumps_of_body.h"

namespace palpate::servo {

namespace {

/// Uncertainty of the delay: a tick and an amplifier that was not measured, or 1.5 ms. Too long a delay adds damping,
/// which a device with hardly any friction needs: with less it rings on for a second under a dead load.
constexpr double kAmplifierS = 0.0005;
constexpr double kMinMarginS = 0.0015;
constexpr double kIdentifiedMarginTicks = 0.5;

double assumedMarginTicks(double tick_s) { return std::max(tick_s + kAmplifierS, kMinMarginS) / tick_s; }

/// The share of a device's damping and friction that is counted on. Assumed ones count for nothing: a device with 0 to
/// 15 % of the friction that was assumed kept a limit cycle alive within a tenth of it.
struct Trust {
  double damping;
  double friction;
};
constexpr Trust kAssumed{0.0, 0.0};
constexpr Trust kIdentified{0.5, 0.25};

/// Stable stiffness of one rate, N/mm, by the delay in whole ticks; 0: none. About four fifths of the stiffest step of
/// a ladder (20 %) on which none of 360 random systems (180 from 2 kHz on) of any device of that class oscillated or
/// left energy at the port: another seed than that of `palpate study stability --map`, which checks it. Its 52,500
/// systems lowered two more: at 1 kHz and two ticks a Premium 3.0 under a dead load (1 of 60 swung on at 1.0), at 500
/// Hz and one tick a Touch X in a hand (1 of 60 at 0.3); those of a second seed, at 4 kHz under a dead load, a Falcon
/// at three ticks (1 of 60 at 1.2) and a Premium 1.5 at four (1 of 60 at 0.8). From 2 kHz on a Falcon under a dead
/// load, with 1 % of its friction, decides the heavy ones: its encoder is too coarse for the controller.
struct StableRow {
  double ticks_per_s;
  std::array<double, 7> light;  ///< below kHeavyKg, and every open device that is unknown
  std::array<double, 7> heavy;
};
constexpr double kHeavyKg = 0.15;
constexpr std::array kStable = {
    StableRow{4000.0, {2.5, 1.8, 1.3, 1.0, 0.6, 0.5, 0.4}, {3.0, 1.8, 1.3, 1.0, 0.6, 0.5, 0.4}},
    StableRow{2000.0, {2.5, 1.5, 1.0, 0.7, 0.6, 0.5, 0.4}, {3.0, 1.8, 1.2, 1.0, 0.8, 0.6, 0.5}},
    StableRow{1000.0, {2.5, 1.1, 0.5, 0.0, 0.0, 0.0, 0.0}, {3.0, 2.0, 0.8, 2.0 / 3.0, 0.5, 0.4, 0.0}},
    StableRow{500.0, {1.0, 0.2, 0.0, 0.0, 0.0, 0.0, 0.0}, {2.0, 0.75, 0.4, 0.0, 0.0, 0.0, 0.0}},
    StableRow{250.0, {0.25, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0}, {0.9, 0.2, 0.0, 0.0, 0.0, 0.0, 0.0}}};

/// A scene without a device, or a device of 150 g and more: nothing that is lighter can be in the hand.
bool isHeavy(const device::DeviceProfile& profile) {
  if (!profile.known) return !profile.open;
  return profile.mass_kg * profile.motion_scale >= kHeavyKg;
}

constexpr double kMaxPassivityForce = 1.5;
constexpr double kPassivityShare = 0.4;  // share of the largest force

bool isIdentified(const scene::SafetySettings& safety) {
  return safety.device_damping_n_s_per_mm > 0.0 && safety.device_friction_n > 0.0;
}

/// The depth at which the stiffest place gives this force, at most `most_mm`.
double depthOfForce(const tissue::ForceLaw& law, double stiffness, double force_n, double most_mm) {
  double low = 0.0;
  double high = most_mm;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (tissue::normalForce(law, stiffness, middle) < force_n ? low : high) = middle;
  }
  return high;
}

/// The force up to which no slope is above the cap, N.
double forceBelowSlope(const tissue::ForceLaw& law, double stiffness, double most_mm, double cap_n_per_mm) {
  constexpr double kStepMm = 0.05;
  double force_n = 0.0;
  for (double depth = kStepMm; depth < most_mm; depth += kStepMm) {
    if (tissue::tangentStiffness(law, stiffness, depth) > cap_n_per_mm) return force_n;
    force_n = tissue::normalForce(law, stiffness, depth);
  }
  return std::numeric_limits<double>::infinity();
}

/// The stiffest place of one thickness of tissue.
struct Stiffest {
  double stiffness_n_per_mm = 0.0;
  double tissue_mm = 0.0;
};

/// One for the whole skin; with layered tissue one a class of thickness, since thin tissue has both the stiffest map
/// and the steepest law, and thick tissue neither.
std::vector<Stiffest> stiffestPlaces(const scene::World& world) {
  const std::vector<double>& stiffness = *world.surface.stiffness_n_per_mm;
  const std::vector<double>& tissue = world.surface.tissue_mm;
  if (tissue.empty()) return {{*std::max_element(stiffness.begin(), stiffness.end())}};
  constexpr double kClassMm = 1.0;
  std::map<int, Stiffest> classes;
  for (std::size_t v = 0; v < stiffness.size(); ++v) {
    Stiffest& place = classes[static_cast<int>(tissue[v] / kClassMm)];
    if (stiffness[v] > place.stiffness_n_per_mm) place = {stiffness[v], tissue[v]};
  }
  std::vector<Stiffest> places;
  for (const auto& [thickness, place] : classes) places.push_back(place);
  return places;
}

/// The steepest of a lump comes on top of the place that it lies under.
std::vector<Stiffest> stiffestLumps(const scene::World& world) {
  std::vector<Stiffest> places;
  for (const auto& placed : world.lumps) {
    const contact::Lump& lump = placed->lump;
    const tissue::LumpSteepness steepness = lump.energy.steepest();
    const tree::NearestPoint skin = tree::nearestPoint(world.surface.geometry->tree, lump.foot, 1.0);
    if (skin.triangle == kNoIndex) continue;
    const contact::SkinHere here =
        contact::skinAt(world.surface, {skin.closest.point, skin.triangle, skin.closest.feature});
    places.push_back({here.stiffness_n_per_mm + std::max(steepness.depth, steepness.rho), here.tissue_mm});
  }
  return places;
}

/// The law of one place under one finger: of layered tissue its only row.
tissue::ForceLaw lawAt(const tissue::ForceLaw& law, const tissue::PressedPlace& place) {
  if (law.kind != tissue::ForceLaw::Kind::layered || law.layers.rows == 0) return law;
  tissue::ForceLaw here = law;
  here.layers.rows = 1;
  here.layers.thinnest_mm = place.tissue_mm;
  here.layers.knows_radius = false;
  for (std::uint32_t i = 1; i < tissue::LayeredForce::kDepths; ++i) {
    const double depth = tissue::LayeredForce::kDepthStepMm * i;
    here.layers.factor[tissue::LayeredForce::kFingertip][0][i] =
        tissue::respond(law, 1.0, depth, place).secant_n_per_mm;
  }
  return here;
}

/// Radius of the finger that feels the steepest forces: the larger, the stiffer. A fingertip at least, since settings
/// of a finger may change while it is held.
double largestFinger(const scene::Scene& scene, const tissue::ForceLaw& law) {
  double largest_mm = std::max(tissue::kFingertipMm, law.layers.point_mm);
  for (const scene::Finger& finger : scene.fingers) largest_mm = std::max(largest_mm, finger.radius_mm);
  return largest_mm;
}

/// A stiffest place as that finger feels it, `sideways` times as stiff where it drags.
struct FeltPlace {
  tissue::ForceLaw law;
  double stiffness_n_per_mm = 0.0;
};

std::vector<FeltPlace> feltPlaces(const scene::World& world, double finger_mm, double sideways) {
  std::vector<FeltPlace> places;
  std::vector<Stiffest> stiffest = stiffestPlaces(world);
  for (const Stiffest& place : stiffestLumps(world)) stiffest.push_back(place);
  for (const Stiffest& place : stiffest) {
    places.push_back(
        {lawAt(world.surface.force_law, {place.tissue_mm, finger_mm}), place.stiffness_n_per_mm * sideways});
  }
  return places;
}

PassivitySettings makePassivity(const scene::SafetySettings& safety, const device::DeviceProfile& profile,
                                double force_n, double tick_s) {
  const bool identified = isIdentified(safety);
  const Trust trust = identified ? kIdentified : kAssumed;
  return {.on = safety.passivity && stableStiffness(tick_s, safety.delay_ticks, profile) > 0.0,
          .delay_ticks = safety.delay_ticks + (identified ? kIdentifiedMarginTicks : assumedMarginTicks(tick_s)),
          .damping_n_s_per_mm = trust.damping * (identified ? safety.device_damping_n_s_per_mm / profile.motion_scale
                                                            : profile.damping_n_s_per_mm),
          .friction_n = trust.friction * (identified ? safety.device_friction_n : profile.friction_n),
          .mass_kg = profile.mass_kg,
          .encoder_mm = profile.encoder_mm,
          .most_n = std::min(kMaxPassivityForce, kPassivityShare * force_n)};
}

/// A number of [safety] that a scene may make stricter at will, and looser within bounds where a hand is on a device.
struct Guard {
  const char* key;
  double scene::SafetySettings::*member;
  double least;
  double most;
  bool of_motion = false;  ///< in mm of the body, which the device's scale makes of the hand's
};
constexpr scene::SafetySettings kUsual;
constexpr double kNoBound = std::numeric_limits<double>::infinity();
constexpr std::array kGuards = {
    Guard{"ramp_s", &scene::SafetySettings::ramp_s, kQuickestRampS, kNoBound},
    Guard{"max_age_ticks", &scene::SafetySettings::max_age_ticks, 0.0, kLoosestGuard* kUsual.max_age_ticks},
    Guard{"max_jump_mm", &scene::SafetySettings::max_jump_mm, 0.0, kLoosestGuard* kUsual.max_jump_mm, true},
    Guard{"max_tip_speed_mm_per_s", &scene::SafetySettings::max_tip_speed_mm_per_s, 0.0,
          kLoosestGuard* kUsual.max_tip_speed_mm_per_s, true},
    Guard{"max_force_rate_n_per_ms", &scene::SafetySettings::max_force_rate_n_per_ms, 0.0,
          kLoosestGuard* kUsual.max_force_rate_n_per_ms},
};

double upperLimit(const Guard& guard, const device::DeviceProfile& profile) {
  return guard.of_motion ? guard.most * std::max(1.0, profile.motion_scale) : guard.most;
}

scene::SafetySettings withoutConsent(scene::SafetySettings asked) {
  asked.unsafe_stiffness = false;
  return asked;
}

/// --unsafe-stiffness was given and makes a difference.
bool exceedsSafe(const scene::SafetySettings& asked, const device::DeviceProfile& profile, double tick_s) {
  if (!asked.unsafe_stiffness) return false;
  const scene::SafetySettings safe = withoutConsent(asked);
  const scene::SafetySettings held = effectiveSafety(asked, profile);
  const scene::SafetySettings kept = effectiveSafety(safe, profile);
  return stiffnessCap(asked, profile, tick_s) > stiffnessCap(safe, profile, tick_s) ||
         device::largestForceN(asked, profile) > device::largestForceN(safe, profile) ||
         held.passivity != kept.passivity || held.soft_contact != kept.soft_contact;
}

}  // namespace

double stableStiffness(double tick_s, double delay_ticks, const device::DeviceProfile& profile) {
  constexpr double kRounding = 1e-9;
  const double ticks = std::max(0.0, std::ceil(delay_ticks - kRounding));
  for (const StableRow& row : kStable) {
    if (tick_s > (1.0 + kRounding) / row.ticks_per_s) continue;
    const auto& stable = isHeavy(profile) ? row.heavy : row.light;
    return ticks < static_cast<double>(stable.size()) ? stable[static_cast<std::size_t>(ticks)] : 0.0;
  }
  return 0.0;
}

std::string refusalReason(const device::DeviceProfile& profile, double tick_s, double delay_ticks) {
  if (stableStiffness(tick_s, delay_ticks, profile) > 0.0) return {};
  return fmt::format(
      "no stiffness is stable at {:.4g} Hz with {:.3g} ticks of delay on {}; increase `ticks_per_s`, or reduce "
      "`[safety] delay_ticks` if the real delay is less (docs/explanation/safety.md)",
      1.0 / tick_s, delay_ticks, isHeavy(profile) ? "this device" : "a device this light or unknown");
}

void requireStable(const device::DeviceProfile& profile, const scene::SafetySettings& safety, double tick_s) {
  if (!profile.open) return;
  const double delay_ticks = effectiveSafety(safety, profile).delay_ticks;
  if (const std::string why = refusalReason(profile, tick_s, delay_ticks); !why.empty()) throw Error(why);
}

scene::SafetySettings effectiveSafety(const scene::SafetySettings& asked, const device::DeviceProfile& profile) {
  scene::SafetySettings held = asked;
  held.delay_ticks = std::max(asked.delay_ticks, profile.delay_ticks);
  if (!profile.open) return held;
  for (const Guard& guard : kGuards) {
    held.*guard.member = std::clamp(asked.*guard.member, guard.least, upperLimit(guard, profile));
  }
  held.passivity = asked.passivity || !asked.unsafe_stiffness;
  held.soft_contact = asked.soft_contact || !asked.unsafe_stiffness;
  return held;
}

double stiffnessCap(const scene::SafetySettings& safety, const device::DeviceProfile& profile, double tick_s) {
  const double delay_ticks = std::max(safety.delay_ticks, profile.delay_ticks);
  double cap = std::max(kSoftestCap, stableStiffness(tick_s, delay_ticks, profile)) / profile.motion_scale;
  if (profile.stiffness_n_per_mm > 0.0) cap = std::min(cap, profile.stiffness_n_per_mm);
  if (!(safety.stiffness_cap_n_per_mm > 0.0)) return cap;
  const double asked = safety.stiffness_cap_n_per_mm / profile.motion_scale;
  return safety.unsafe_stiffness ? asked : std::min(cap, asked);
}

std::vector<std::string> safetyNotes(const scene::SafetySettings& asked, const device::DeviceProfile& profile,
                                     double tick_s) {
  const scene::SafetySettings safe = withoutConsent(asked);
  const scene::SafetySettings held = effectiveSafety(asked, profile);
  const double scale = profile.motion_scale;  // a cap is requested as the hand feels it
  const double safe_cap = scale * stiffnessCap(safe, profile, tick_s);
  const double cap = scale * stiffnessCap(asked, profile, tick_s);
  const double safe_n = device::largestForceN(safe, profile);
  const double force_n = device::largestForceN(asked, profile);
  std::vector<std::string> notes;
  const auto note = [&notes](std::string text) { notes.push_back("[safety] " + std::move(text)); };
  if (exceedsSafe(asked, profile, tick_s)) {
    notes.push_back(
        fmt::format("{} (--unsafe-stiffness): up to {:.3g} N/mm and {:.3g} N{}{}, but only {:.3g} N/mm and {:.3g} N "
                    "are safe; the loop may oscillate",
                    kUnsafeMark, cap, force_n, held.passivity ? "" : ", without passivity",
                    held.soft_contact ? "" : ", without soft contact", safe_cap, safe_n));
  }
  if (asked.stiffness_cap_n_per_mm > cap) {
    note(
        fmt::format("stiffness_cap_n_per_mm = {:.3g} is more than device, rate and delay can render stably; limited to "
                    "{:.3g} N/mm, only --unsafe-stiffness allows more",
                    asked.stiffness_cap_n_per_mm, cap));
  }
  if (asked.nominal_force_n > force_n) {
    note(fmt::format("nominal_force_n = {:.3g} is more than {} can render; limited to {:.3g} N{}",
                     asked.nominal_force_n, profile.known ? "the device" : "an unknown device", force_n,
                     profile.known ? "" : ", the weakest known device's"));
  }
  if (held.delay_ticks > asked.delay_ticks) {
    note(fmt::format("delay_ticks = {:.3g} is less than the device's own; using {:.3g}", asked.delay_ticks,
                     held.delay_ticks));
  }
  for (const Guard& guard : kGuards) {
    const double value = held.*guard.member;
    const bool heeded = guard.member != &scene::SafetySettings::ramp_s || asked.start == scene::StartRule::ramp;
    if (heeded && value != asked.*guard.member) {
      note(fmt::format("{} = {:.3g} is too large for a device held by hand; limited to {:.3g}", guard.key,
                       asked.*guard.member, value));
    }
  }
  if (held.passivity != asked.passivity) note("passivity = false: on a device it stays on");
  if (held.soft_contact != asked.soft_contact) note("soft_contact = false: on a device it stays on");
  if (profile.open && isIdentified(asked)) {
    note(
        "damping and friction of the device are taken from the scene: they must be measured on this very device "
        "(palpate devices --identify)");
  }
  return notes;
}

double stiffnessFactor(const tissue::ForceLaw& law, double stiffness_n_per_mm, double most_mm, double force_n,
                       double cap_n_per_mm) {
  const auto steepest = [&](double factor) {
    const double depth = depthOfForce(law, stiffness_n_per_mm, force_n / factor, most_mm);
    return factor * stiffness_n_per_mm * tissue::steepestFactor(law, depth);
  };
  if (!(steepest(1.0) > cap_n_per_mm)) return 1.0;
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (steepest(middle) > cap_n_per_mm ? high : low) = middle;
  }
  return low;
}

LimiterSettings limiterSettings(const scene::SafetySettings& asked, const device::DeviceProfile& profile,
                                double tick_s) {
  const scene::SafetySettings safety = effectiveSafety(asked, profile);
  LimiterSettings settings;
  settings.unsafe = exceedsSafe(asked, profile, tick_s);
  settings.tick_s = tick_s;
  settings.force_n = device::largestForceN(safety, profile);
  if (profile.open && !(stableStiffness(tick_s, safety.delay_ticks, profile) > 0.0)) settings.force_n = 0.0;
  settings.soft_contact = safety.soft_contact;
  settings.start = safety.start;
  settings.ramp_s = safety.ramp_s;
  settings.max_age_ticks = safety.max_age_ticks;
  settings.max_jump_mm = safety.max_jump_mm;
  settings.max_tip_speed_mm_per_s = safety.max_tip_speed_mm_per_s;
  settings.max_force_rate_n_per_ms = safety.max_force_rate_n_per_ms;
  settings.passivity = makePassivity(safety, profile, settings.force_n, tick_s);
  return settings;
}

LimiterSettings limiterSettings(const scene::World& world, const device::DeviceProfile& profile, double tick_s) {
  const scene::Scene& scene = world.scene;
  const tissue::ForceLaw& law = world.surface.force_law;
  const double most_mm = scene.contact.finger.max_depth_mm;
  LimiterSettings settings = limiterSettings(scene.safety, profile, tick_s > 0.0 ? tick_s : 1.0 / scene.ticks_per_s);
  const double sideways = std::max(1.0, scene.contact.finger.stiffness_ratio);
  const double cap = stiffnessCap(scene.safety, profile, settings.tick_s);
  const std::vector<FeltPlace> places = feltPlaces(world, largestFinger(scene, law), sideways);
  // The slopes of the other laws are not held: for them the factor looks at all forces.
  const bool holds_slopes = law.kind == tissue::ForceLaw::Kind::layered;
  const double compared_n = holds_slopes ? std::min(kComparedForceN, settings.force_n) : settings.force_n;
  for (const auto& [here, stiffest] : places) {
    const double factor = stiffnessFactor(here, stiffest, most_mm, compared_n, cap);
    settings.stiffness_factor = std::min(settings.stiffness_factor, factor);
  }
  settings.stiffness_n_per_mm = settings.steepest = 0.0;
  settings.compared_n = settings.force_n;
  for (const auto& [here, stiffest] : places) {
    const double depth = depthOfForce(here, stiffest, settings.force_n / settings.stiffness_factor, most_mm);
    const double steepest = tissue::steepestFactor(here, depth);
    settings.steepest = std::max(settings.steepest, steepest);
    settings.stiffness_n_per_mm = std::max(settings.stiffness_n_per_mm, stiffest * steepest);
    const double unheld_n = forceBelowSlope(here, settings.stiffness_factor * stiffest, most_mm, cap);
    settings.compared_n = std::min(settings.compared_n, std::max(compared_n, unheld_n));
  }
  // Exceeding the cap by rounding does not count.
  if (settings.stiffness_n_per_mm * settings.stiffness_factor > cap * (1.0 + 1e-9)) {
    settings.cap_n_per_mm = cap / sideways;
    settings.stiffness_n_per_mm = cap / settings.stiffness_factor;
  }
  return settings;
}

LimiterSettings limiterSettings(const scene::World& world) {
  return limiterSettings(world, device::profileOf(world.scene.safety.device));
}

}  // namespace palpate::servo
