// The energy that a sampled, delayed loop gives to a hand beyond the force law that it renders, and the damping that
// takes it back.
//
//   model force, motion of the tip, what was really sent -> observe -> loss G -> passivityForce -> a force along the
//   model's
//
// A spring that is sampled and held pushes a little more on the way out than on the way in. The observer adds up that
// difference, tick by tick, against the model itself and not against zero: the skin may take energy (friction) and give
// it (a stiff place next to a soft one) by its own law, and only the loop's part is counted. Based on: Hannaford and
// Ryu, "Time-domain passivity control of haptic interfaces", IEEE Trans. Robot. Autom. 18 (2002), and later work that
// compares with a reference energy. The treatment of delay, friction and bounds is our own;
// docs/explanation/safety.md measures it.
#pragma once

#include <array>

#include "palpate/base/vec.h"

namespace palpate::servo {

/// Longest delay that the observer can follow, in ticks.
inline constexpr double kLongestDelayTicks = 12.0;

struct PassivitySettings {
  bool on = true;
  /// Assumed from sampling to the force acting, in ticks. Too much costs noise, too little takes the protection away.
  double delay_ticks = 2.0;
  // Losses that the device itself surely absorbs, a share of its damping and friction: these are left alone.
  double damping_n_s_per_mm = 0.0;
  double friction_n = 0.0;
  // Bounds of the damping that it can make, so that one step of the encoder in a tick is not felt as a blow.
  double mass_kg = 0.045;
  double encoder_mm = 0.055;
  double most_n = 1.32;  ///< largest force that it adds; it may take away twice as much
};

/// Plain data; value-initialised it has sent nothing.
struct PassivityState {
  static constexpr std::size_t kSent = 16;  ///< a power of two above kLongestDelayTicks + 1
  std::array<Vec3, kSent> sent{};           ///< ring; forces written to the device
  std::size_t newest = 0;
  Vec3 model = Vec3::Zero();          ///< in the last tick, N
  Vec3 motion_before = Vec3::Zero();  ///< motion of the tip in the last tick, mm
  double loss_n_mm = 0.0;             ///< G, never below zero: nothing is banked
  int free_ticks = 2;
  PassivityState() { sent.fill(Vec3::Zero()); }
};

/// One tick of the tip, as observer and controller see it.
struct PassivityTick {
  Vec3 motion = Vec3::Zero();  ///< motion of the tip since the last tick, mm
  double tick_s = 0.001;       ///< since the last tick: longer where ticks were missed
  Vec3 model = Vec3::Zero();   ///< the force that the hand should feel, N
  bool touching = false;
};

/// The force to add to the model's, N; zero while nothing is lost.
Vec3 passivityForce(const PassivitySettings& settings, PassivityState& state, const PassivityTick& tick) noexcept;

/// Remembers the force written after every limit.
void remember(PassivityState& state, const Vec3& sent) noexcept;

/// After a fault: nothing is lost, nothing was sent.
void forget(PassivityState& state) noexcept;

}  // namespace palpate::servo
