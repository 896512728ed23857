// Device's reading -> guardTip -> contact -> limitForce -> device's force. Based on: see limiter.h.
#include "palpate/servo/limiter.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace palpate::servo {

namespace {

constexpr double kMillisecond = 0.001;

/// A smaller share of the model's force is the rounding of the encoder and a delay that is assumed too long.
constexpr double kNoticed = 0.1;

/// The controller in more than this share of a second's contact: the scene is too stiff for this device and rate.
constexpr double kTooOften = 0.3;

bool isFinite(const Vec3& v) { return std::isfinite(v.x()) && std::isfinite(v.y()) && std::isfinite(v.z()); }

void moveTip(LimiterState& state, const Pose& pose) {
  state.motion = state.has_tip ? Vec3(pose.tip - state.tip) : Vec3::Zero();
  state.elapsed_ticks = state.has_tip ? std::max(1.0, static_cast<double>(pose.tick - state.tick)) : 1.0;
  state.tip = pose.tip;
  state.tick = pose.tick;
  state.has_tip = true;
}

/// Ends the tick with this force.
Vec3 send(LimiterState& state, const Vec3& force) {
  remember(state.passivity, force);
  state.force = force;
  for (std::uint32_t bits = state.status; bits != 0; bits &= bits - 1) {
    ++state.counts[static_cast<std::size_t>(std::countr_zero(bits))];
  }
  return force;
}

/// No force in this tick, and nothing that was before counts any more.
Vec3 stop(LimiterState& state) {
  forget(state.passivity);
  state.soft = {};
  state.armed = false;
  state.ramp_ticks = 0.0;
  return send(state, Vec3::Zero());
}

/// Share of the force that may be felt after a start or a fault: 1 once the tip has been outside.
double startShare(const LimiterSettings& settings, LimiterState& state, bool touching) {
  state.armed = state.armed || !touching;
  if (state.armed) return 1.0;
  const double ticks = settings.ramp_s / settings.tick_s;
  if (settings.start == scene::StartRule::outside) {
    state.status |= kHeldBack;
    return 0.0;
  }
  if (state.ramp_ticks >= ticks) {
    state.armed = true;
    return 1.0;
  }
  state.status |= kRamping;
  state.ramp_ticks += 1.0;
  // A ramp of a fractional number of ticks must not overshoot in its last one.
  return std::min(1.0, state.ramp_ticks / ticks);
}

/// The share of the contact's force that is felt because of the way this contact began, and because its slope is held.
double feltShare(const LimiterSettings& settings, LimiterState& state, const contact::FingerOutput& contact,
                 const tissue::ForceLaw& law) {
  const double depth = contact.depth_mm;
  double felt = depth;
  if (settings.soft_contact) {
    const Vec3 step = 0.5 * (state.motion + state.passivity.motion_before);
    felt = softDepth(state.soft, contact, law,
                     {.step_mm = -step.dot(contact.normal),
                      .stiffness_factor = settings.stiffness_factor,
                      .steepest = settings.steepest,
                      .cap_n_per_mm = settings.cap_n_per_mm});
    if (felt < depth) state.status |= kSoftened;
  }
  const bool held = settings.cap_n_per_mm > 0.0 && law.kind == tissue::ForceLaw::Kind::layered && depth > 0.0 &&
                    contact.force.dot(contact.normal) > 0.0;
  if (!held && !(felt < depth)) return 1.0;
  if (law.kind == tissue::ForceLaw::Kind::linear) return felt / depth;
  const tissue::PressedPlace place{contact.tissue_mm, contact.finger_mm};
  const double whole = tissue::normalForce(law, 1.0, depth, place);
  if (!(whole > 0.0)) return 1.0;
  if (!held) return tissue::normalForce(law, 1.0, felt, place) / whole;
  // A place is known by its force alone, which includes the map, the finger and its past.
  const double stiffness = settings.stiffness_factor * localStiffness(contact, law);
  return tissue::cappedForce(law.layers, 1.0, felt, place, settings.cap_n_per_mm / stiffness) / whole;
}

Vec3 clamped(const LimiterSettings& settings, LimiterState& state, const Vec3& force) {
  const double length = force.norm();
  if (length <= settings.force_n) return force;
  state.status |= kClamped;
  // An overlong but finite vector can have an infinite length: scale it down first.
  const double largest = force.cwiseAbs().maxCoeff();
  const Vec3 safe = std::isfinite(length) ? force : Vec3(force / largest);
  return safe * (settings.force_n / safe.norm());
}

/// A force that falls is never too fast.
bool jumps(const LimiterSettings& settings, const LimiterState& state, const Vec3& force) {
  const double most = settings.max_force_rate_n_per_ms * settings.tick_s * state.elapsed_ticks / kMillisecond;
  return (force - state.force).squaredNorm() > most * most && force.squaredNorm() > state.force.squaredNorm();
}

/// Once in a second of contact: does the controller do much, too often?
void watchStiffness(const LimiterSettings& settings, LimiterState& state, bool touching, bool noticeable) {
  if (!touching) return;
  state.contact_ticks += 1;
  state.damped_ticks += noticeable ? 1 : 0;
  if (static_cast<double>(state.contact_ticks) * settings.tick_s < 1.0) return;
  if (static_cast<double>(state.damped_ticks) > kTooOften * static_cast<double>(state.contact_ticks)) {
    state.status |= kTooStiff;
  }
  state.contact_ticks = state.damped_ticks = 0;
}

}  // namespace

Vec3 guardTip(const LimiterSettings& settings, LimiterState& state, const Pose& pose) noexcept {
  state.status = 0;
  if (!isFinite(pose.tip)) {
    state.status |= kTipNotFinite;
    state.motion.setZero();
    return state.tip;
  }
  if (!(pose.age_ticks <= settings.max_age_ticks)) state.status |= kTipStale;
  moveTip(state, pose);
  const double most =
      std::max(settings.max_jump_mm, settings.max_tip_speed_mm_per_s * settings.tick_s * state.elapsed_ticks);
  if (!(state.motion.norm() <= most)) state.status |= kTipJumped;
  return state.tip;
}

void reportFault(LimiterState& state, SafetyBit why) noexcept { state.status |= why; }

Vec3 limitForce(const LimiterSettings& settings, LimiterState& state, const contact::FingerOutput& contact,
                const tissue::ForceLaw& law) noexcept {
  if (!isFinite(contact.force)) state.status |= kForceNotFinite;
  if (!settings.limited) return send(state, (state.status & kForceNotFinite) != 0 ? Vec3(Vec3::Zero()) : contact.force);
  if ((state.status & kFaultBits) != 0) return stop(state);
  const bool touching = contact.touch != contact::Touch::free;
  const double share = startShare(settings, state, touching) * feltShare(settings, state, contact, law);
  const Vec3 model = (share * settings.stiffness_factor) * contact.force;
  const Vec3 taken = passivityForce(settings.passivity, state.passivity,
                                    {.motion = state.motion,
                                     .tick_s = settings.tick_s * state.elapsed_ticks,
                                     .model = state.closes_loop ? model : Vec3(Vec3::Zero()),
                                     .touching = touching && state.closes_loop});
  if (!taken.isZero(0.0)) state.status |= kDamped;
  const Vec3 force = clamped(settings, state, model + taken);
  if (jumps(settings, state, force)) {
    state.status |= kForceJumped;
    return stop(state);
  }
  watchStiffness(settings, state, touching, taken.squaredNorm() > kNoticed * kNoticed * model.squaredNorm());
  return send(state, force);
}

const std::array<const char*, kSafetyBits>& safetyNames() noexcept {
  static constexpr std::array<const char*, kSafetyBits> kNames = {
      "tip not finite", "tip jumped",     "force not finite", "force ramps up", "damped",
      "force clamped",  "force jumped",   "loop stalled",     "tip stale",      "held back",
      "soft contact",   "emergency stop", "too stiff",        "clutched"};
  return kNames;
}

}  // namespace palpate::servo
