// Guards, clamps and ramps, in the order of the signal: what the device says -> guardTip -> contact -> limitForce ->
// what the device gets. Based on: see limiter.h.
#include "palpate/servo/limiter.h"

#include <algorithm>
#include <cmath>

namespace palpate::servo {

namespace {

/// The slew limit's constant part is given per millisecond.
constexpr double kMillisecond = 0.001;

bool isFinite(const Vec3& v) { return std::isfinite(v.x()) && std::isfinite(v.y()) && std::isfinite(v.z()); }

void moveTip(LimiterState& state, const Vec3& tip) {
  state.motion = state.has_tip ? Vec3(tip - state.tip) : Vec3::Zero();
  state.tip = tip;
  state.has_tip = true;
}

Vec3 finiteOrZero(const Vec3& force, LimiterState& state) {
  if (isFinite(force)) return force;
  state.status |= kForceNotFinite;
  return Vec3::Zero();
}

Vec3 ramped(const LimiterSettings& settings, LimiterState& state, const Vec3& force) {
  const double ticks = settings.safety.ramp_s / settings.tick_s;
  if (state.ramp_ticks >= ticks) return force;
  state.status |= kRamping;
  state.ramp_ticks += 1.0;
  // A ramp that is no whole number of ticks must not overshoot in its last one.
  return std::min(1.0, state.ramp_ticks / ticks) * force;
}

/// The force of the last tick was held while the tip moved: it gave force . motion to the hand.
void observeEnergy(LimiterState& state, const Vec3& wanted) {
  state.energy_n_mm -= state.force.dot(state.motion);
  // In free air a debt would be felt as stickiness and a credit would hide what the next touch does.
  if (wanted.isZero(0.0) && state.force.isZero(0.0)) state.energy_n_mm = 0.0;
}

/// Takes away push along the motion until the energy is back in balance. It never brakes: a push is at most cancelled,
/// so no gain of it can make a sampled loop rattle, as an ordinary damper of the needed strength would.
Vec3 damped(const LimiterSettings& settings, LimiterState& state, const Vec3& force) {
  observeEnergy(state, force);
  const double excess = -state.energy_n_mm - settings.safety.passivity_allowance_n_mm;
  const double path = state.motion.norm();
  const double push = path > 0.0 ? force.dot(state.motion) / path : 0.0;
  if (!settings.safety.passivity || excess <= 0.0 || push <= 0.0) return force;
  state.status |= kDamped;
  return force - std::min(push, excess / path) / path * state.motion;
}

Vec3 clamped(const LimiterSettings& settings, LimiterState& state, const Vec3& force) {
  const double length = force.norm();
  if (length <= settings.safety.nominal_force_n) return force;
  state.status |= kClamped;
  // An overlong but finite vector can have an infinite length: scale it down first.
  const double largest = force.cwiseAbs().maxCoeff();
  const Vec3 safe = std::isfinite(length) ? force : Vec3(force / largest);
  return safe * (settings.safety.nominal_force_n / safe.norm());
}

Vec3 slewLimited(const LimiterSettings& settings, LimiterState& state, const Vec3& force) {
  const scene::SafetySettings& safety = settings.safety;
  const double path = safety.slew_per_motion * state.motion.norm() + safety.slew_mm * settings.tick_s / kMillisecond;
  const double limit = settings.stiffness_n_per_mm * path;
  const Vec3 change = force - state.force;
  const double length = change.norm();
  if (!(length > limit)) return force;
  state.status |= kSlewLimited;
  return state.force + change * (limit / length);
}

}  // namespace

Vec3 guardTip(const LimiterSettings& settings, LimiterState& state, const Vec3& measured) noexcept {
  state.status = 0;
  if (!isFinite(measured)) {
    moveTip(state, state.tip);
    restartRamp(state, kTipNotFinite);
    return state.tip;
  }
  moveTip(state, measured);
  if (!(state.motion.norm() <= settings.safety.max_tip_speed_mm_per_s * settings.tick_s)) {
    restartRamp(state, kTipJumped);
    // Whatever moved the tip was not a hand working against the force: no energy, and no licence to change it fast.
    state.motion.setZero();
  }
  return state.tip;
}

void restartRamp(LimiterState& state, SafetyBit why) noexcept {
  state.status |= why;
  state.ramp_ticks = 0.0;
}

Vec3 limitForce(const LimiterSettings& settings, LimiterState& state, const Vec3& contact_force) noexcept {
  const Vec3 finite = finiteOrZero(contact_force, state);
  const Vec3 grown = ramped(settings, state, finite);
  const Vec3 bounded = clamped(settings, state, grown);
  const Vec3 passive = damped(settings, state, bounded);
  state.force = slewLimited(settings, state, passive);
  return state.force;
}

}  // namespace palpate::servo
