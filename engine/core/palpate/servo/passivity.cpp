// Observer, then controller. The work of the model is the trapezoid of two ticks (exact for springs), the work of the
// device is that of the held, delayed, clamped force. Based on: see passivity.h.
#include "palpate/servo/passivity.h"

#include <algorithm>
#include <cmath>

namespace palpate::servo {

namespace {

/// Slower than this the direction of the motion is noise, and the damping needed would have no bound, mm/s.
constexpr double kMinSpeed = 0.1;
/// The greatest damping: N s/mm, as a share of the mass that stops in a tick, and in N for one step of the encoder.
constexpr double kMaxDamping = 0.020;
constexpr double kMassShare = 0.22;
constexpr double kForceOfAStep = 0.4;
/// The controller may pull into the surface by this much, N.
constexpr double kMaxPull = 0.05;
/// Taking force away does not kick, so where much was lost more may be taken than added: up to twice as much, for 2 mJ.
/// Without it a tap at 0.5 m/s on 3 N/mm leaves 1.3 mJ at the device's port, with it none; always twice as much would
/// return in one tick at the end, as a step.
constexpr double kMaxTaken = 2.0;
constexpr double kLossOfMore = 2.0;  // N mm
/// Samples without contact after which a loss is forgotten.
constexpr int kForgetTicks = 2;
/// 1 kg = 1e-3 N s^2/mm.
constexpr double kKilogram = 1e-3;

/// The force on the device since the last tick, N.
Vec3 applied(const PassivityState& state, double delay_ticks) {
  const double delay = std::clamp(delay_ticks, 0.0, kLongestDelayTicks);
  const auto whole = static_cast<std::size_t>(delay);
  const double part = delay - static_cast<double>(whole);
  const auto ago = [&](std::size_t ticks) -> const Vec3& {
    return state.sent[(state.newest - ticks) % PassivityState::kSent];
  };
  return (1.0 - part) * ago(whole) + part * ago(whole + 1);
}

void observe(const PassivitySettings& settings, PassivityState& state, const PassivityTick& tick) {
  state.free_ticks = tick.touching ? 0 : std::min(kForgetTicks, state.free_ticks + 1);
  if (state.free_ticks >= kForgetTicks) {
    state.loss_n_mm = 0.0;
    return;
  }
  const double squared = tick.motion.squaredNorm();
  const double swallowed =
      settings.damping_n_s_per_mm * squared / tick.tick_s + settings.friction_n * std::sqrt(squared);
  const Vec3 too_much = applied(state, settings.delay_ticks) - 0.5 * (tick.model + state.model);
  state.loss_n_mm = std::max(0.0, state.loss_n_mm + too_much.dot(tick.motion) - swallowed);
}

double mostDamping(const PassivitySettings& settings, double tick_s) {
  return std::min(
      {kMaxDamping, kMassShare * settings.mass_kg * kKilogram / tick_s, kForceOfAStep * tick_s / settings.encoder_mm});
}

/// Along the model's force only: across it, it would brake sliding.
Vec3 control(const PassivitySettings& settings, const PassivityState& state, const PassivityTick& tick) {
  if (!(state.loss_n_mm > 0.0)) return Vec3::Zero();
  const double strength = tick.model.norm();
  const double speed =
      strength > 0.0 ? tick.model.dot(tick.motion + state.motion_before) / (2.0 * strength * tick.tick_s) : 0.0;
  if (!(std::abs(speed) > kMinSpeed)) return Vec3::Zero();
  const double damping = std::min(state.loss_n_mm / (tick.tick_s * speed * speed), mostDamping(settings, tick.tick_s));
  const double most_added = std::min(settings.most_n, strength + kMaxPull);
  const double share = std::min(kMaxTaken, 1.0 + state.loss_n_mm / kLossOfMore);
  const double most_taken = std::min(share * settings.most_n, strength + kMaxPull);
  const double force = std::clamp(-damping * speed, -most_taken, most_added);
  return (force / strength) * tick.model;
}

}  // namespace

Vec3 passivityForce(const PassivitySettings& settings, PassivityState& state, const PassivityTick& tick) noexcept {
  observe(settings, state, tick);
  const Vec3 force = settings.on ? control(settings, state, tick) : Vec3::Zero();
  state.model = tick.model;
  state.motion_before = tick.motion;
  return force;
}

void remember(PassivityState& state, const Vec3& sent) noexcept {
  state.newest = (state.newest + 1) % PassivityState::kSent;
  state.sent[state.newest] = sent;
}

void forget(PassivityState& state) noexcept { state = {}; }

}  // namespace palpate::servo
