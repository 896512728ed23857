// Trials of a closed loop that show whether it is safe to touch: a kick, a tap, a slow press, a slide over a map.
#pragma once

#include <cstdint>

#include "lab/loops/closed_loop.h"

namespace palpate::lab {

/// A device with a hand on it and how the loop runs; what every trial starts from.
struct LoopPlan {
  device::DeviceProfile device;
  device::HandModel hand;
  double ticks_per_s = 1000.0;
  double delay_ticks = 1.0;
  double jitter_ticks = 0.0;
  double amplifier_lag_s = 0.0;
  Protection protection = Protection::assumed;
  /// The device that controls are designed for; null: the device itself.
  const device::DeviceProfile* believed = nullptr;
  double believed_delay_ticks = -1.0;  ///< below 0: the true one
  bool quantised = true;
  /// The controller runs also where the product turns it off because nothing is stable (servo::stableStiffness).
  bool controlled_everywhere = true;
  PlateSettings plate;
  std::uint64_t seed = 1;
};

LoopSettings makeLoopSettings(const LoopPlan& plan);

/// A device without friction and encoder, bare, of this mass (kg) and damping (N s/mm), as in theory.
LoopPlan idealPlan(double mass_kg, double damping_n_s_per_mm, double ticks_per_s, double delay_ticks);

/// Up to which stiffness theory calls the bare loop passive, N/mm: b / (T/2 + t_d) ...
double linearLimit(const LoopPlan& plan);
/// ... and by friction and encoder, min(2b/T, 2c/step).
double frictionLimit(const LoopPlan& plan);

// Pressed by 1 N, at rest, then kicked by 1 N for 4 ms.

struct KickResult {
  double peak_to_peak_mm = 0.0;  ///< in the last 0.4 s
  double settled_ms = 0.0;       ///< after the kick: since then within 30 um of the end
  double damped_share = 0.0;     ///< ticks in which the controller acted
  bool oscillates(double encoder_mm) const { return peak_to_peak_mm > 2.0 * encoder_mm; }
};

/// Watched until `wait_s` + 0.4 s after the kick.
KickResult kick(const LoopPlan& plan, double wait_s = 0.4);

/// The least stiffness tried that oscillates after a kick, N/mm, in steps of `factor` from `from`; `to` if none does.
double oscillationOnset(LoopPlan plan, double from, double to, double factor);

/// The least stiffness whose free oscillation about 1 N grows, N/mm, by bisection between the two; for an ideal device
/// without friction and encoder.
double growthOnset(LoopPlan plan, double low, double high);

// Arrives at a speed and stays, or is thrown off.

struct TapResult {
  double first_force_n = 0.0;    ///< in the first tick in contact
  double greatest_step_n = 0.0;  ///< largest growth of the force between two ticks
  double port_energy_mj = 0.0;   ///< the most that the loop gave beyond what it got
  int bounces = 0;               ///< contacts after the first

  /// The greater of each.
  void mergeWorst(const TapResult& other);
};

/// `phase`, 0 to 1: where between two samples the surface is met.
TapResult tap(const LoopPlan& plan, double speed_mm_per_s, double phase);

// Pressed and released at 1 Hz, with a tremor of 0.1 mm at 9 Hz.

struct PressResult {
  double stiffness_bias = 0.0;  ///< slope of motor force over true depth, against the plate's
  double hysteresis = 0.0;      ///< lost in a press over what was put in; below 0: gained
  double noise_n = 0.0;         ///< motor's force above 20 Hz, rms
  double slope_n_per_mm = 0.0;
  double damped_share = 0.0;  ///< ticks in which the controller acted
};

PressResult press(const LoopPlan& plan);

// Slid back and forth over a map at about 94 mm/s.

struct SlideResult {
  double greatest_step_n = 0.0;
  double noise_n = 0.0;
  double port_energy_mj = 0.0;
};

SlideResult slide(const LoopPlan& plan);

}  // namespace palpate::lab
