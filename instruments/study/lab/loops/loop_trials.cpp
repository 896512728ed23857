// Each trial is one run of a ClosedLoop; its numbers come from the true place of the device and the true force of the
// motor, never from what the loop believes.
#include "lab/loops/loop_trials.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace palpate::lab {

namespace {

constexpr double kPushN = 1.0;
/// A firm press, as far as the device goes.
constexpr double kFirmN = 5.0;
constexpr double kFirmShare = 0.7;
constexpr double kDeepestPressMm = 20.0;
constexpr double kTwoPi = 2.0 * std::numbers::pi;

/// The hand's goal, or the load, that presses the plate with this force at rest.
device::HandGoal pressing(const LoopPlan& plan, double force_n) {
  device::HandGoal goal;
  if (plan.hand.mass_kg > 0.0) {
    goal.place.z() = -force_n / plan.plate.stiffness_n_per_mm - force_n / plan.hand.stiffness_n_per_mm;
  } else {
    goal.push.z() = -force_n;
  }
  return goal;
}

std::size_t toTicks(const LoopPlan& plan, double seconds) {
  return static_cast<std::size_t>(std::llround(seconds * plan.ticks_per_s));
}

/// A loop that rests on the plate under this force.
ClosedLoop restingLoop(const LoopPlan& plan, double force_n, double x_mm = 0.0) {
  LoopSettings settings = makeLoopSettings(plan);
  settings.hand.start.x() = x_mm;
  settings.hand.start.z() = -force_n / plan.plate.stiffness_n_per_mm;
  ClosedLoop loop(settings);
  loop.settleContact();
  loop.hand().goal = pressing(plan, force_n);
  loop.hand().goal.place.x() = x_mm;
  return loop;
}

/// Butterworth of the fourth order, above a frequency; two sections.
class HighPass {
 public:
  HighPass(double frequency_hz, double tick_s) {
    const double w = std::tan(0.5 * kTwoPi * frequency_hz * tick_s);
    for (std::size_t i = 0; i < 2; ++i) {
      const double q = 0.5 / std::cos(kTwoPi / 16.0 * (2.0 * static_cast<double>(i) + 1.0));
      const double norm = 1.0 / (1.0 + w / q + w * w);
      sections_[i] = {norm, 2.0 * (w * w - 1.0) * norm, (1.0 - w / q + w * w) * norm};
    }
  }
  double operator()(double value) {
    for (Section& s : sections_) {
      const double out = s.gain * value + s.one;
      s.one = -2.0 * s.gain * value - s.a1 * out + s.two;
      s.two = s.gain * value - s.a2 * out;
      value = out;
    }
    return value;
  }

 private:
  struct Section {
    double gain = 0.0, a1 = 0.0, a2 = 0.0, one = 0.0, two = 0.0;
  };
  std::array<Section, 2> sections_;
};

struct Rms {
  double sum = 0.0;
  std::size_t count = 0;
  void add(double value) {
    sum += value * value;
    ++count;
  }
  double value() const { return count == 0 ? 0.0 : std::sqrt(sum / static_cast<double>(count)); }
};

/// Slope of a straight line through pairs.
struct Slope {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  void add(double px, double py) {
    n += 1.0;
    x += px;
    y += py;
    xx += px * px;
    xy += px * py;
  }
  double value() const { return (n * xy - x * y) / (n * xx - x * x); }
};

}  // namespace

LoopSettings makeLoopSettings(const LoopPlan& plan) {
  const double tick_s = 1.0 / plan.ticks_per_s;
  const double believed = plan.believed_delay_ticks < 0.0 ? plan.delay_ticks : plan.believed_delay_ticks;
  LoopSettings settings;
  settings.hand.device = plan.device;
  settings.hand.hand = plan.hand;
  settings.hand.tick_s = tick_s;
  settings.hand.delay_ticks = plan.delay_ticks;
  settings.hand.jitter_ticks = plan.jitter_ticks;
  settings.hand.amplifier_lag_s = plan.amplifier_lag_s;
  settings.hand.quantised = plan.quantised;
  settings.hand.seed = plan.seed;
  settings.plate = plan.plate;
  settings.limits =
      loopLimiterSettings(plan.believed != nullptr ? *plan.believed : plan.device, tick_s, believed, plan.protection);
  if (plan.controlled_everywhere) settings.limits.passivity.on = plan.protection != Protection::none;
  return settings;
}

LoopPlan idealPlan(double mass_kg, double damping_n_s_per_mm, double ticks_per_s, double delay_ticks) {
  LoopPlan plan;
  plan.device = {true, 100.0, 0.0, mass_kg, damping_n_s_per_mm, 0.0, 0.01};
  plan.quantised = false;
  plan.protection = Protection::none;
  plan.ticks_per_s = ticks_per_s;
  plan.delay_ticks = delay_ticks;
  return plan;
}

double linearLimit(const LoopPlan& plan) {
  return plan.device.damping_n_s_per_mm * plan.ticks_per_s / (0.5 + plan.delay_ticks);
}

double frictionLimit(const LoopPlan& plan) {
  return std::min(2.0 * plan.device.damping_n_s_per_mm * plan.ticks_per_s,
                  2.0 * plan.device.friction_n / plan.device.encoder_mm);
}

void TapResult::mergeWorst(const TapResult& other) {
  first_force_n = std::max(first_force_n, other.first_force_n);
  greatest_step_n = std::max(greatest_step_n, other.greatest_step_n);
  port_energy_mj = std::max(port_energy_mj, other.port_energy_mj);
  bounces = std::max(bounces, other.bounces);
}

KickResult kick(const LoopPlan& plan, double wait_s) {
  ClosedLoop loop = restingLoop(plan, kPushN);
  const std::size_t from = toTicks(plan, 0.4);
  const std::size_t until = from + toTicks(plan, 0.004);
  const std::size_t watched = from + toTicks(plan, wait_s);
  const std::size_t end = watched + toTicks(plan, 0.4);
  const Vec3 push = loop.hand().goal.push;
  std::vector<double> height;
  std::size_t damped = 0;
  for (std::size_t k = 0; k < end; ++k) {
    loop.hand().goal.push = push - (k >= from && k < until ? Vec3(0, 0, kPushN) : Vec3(0, 0, 0));
    damped += (loop.tick().safety & servo::kDamped) != 0 ? 1 : 0;
    height.push_back(loop.hand().place().z());
  }
  const auto [low, high] = std::minmax_element(height.begin() + static_cast<std::ptrdiff_t>(watched), height.end());
  KickResult result;
  result.peak_to_peak_mm = *high - *low;
  result.damped_share = static_cast<double>(damped) / static_cast<double>(end);
  std::size_t last = from;
  for (std::size_t k = from; k < end; ++k) {
    if (std::abs(height[k] - height.back()) > 0.030) last = k + 1;
  }
  result.settled_ms = static_cast<double>(last - from) * 1000.0 / plan.ticks_per_s;
  return result;
}

double oscillationOnset(LoopPlan plan, double from, double to, double factor) {
  for (double stiffness = from; stiffness <= to; stiffness *= factor) {
    plan.plate.stiffness_n_per_mm = stiffness;
    if (kick(plan).oscillates(plan.device.encoder_mm)) return stiffness;
  }
  return to;
}

double growthOnset(LoopPlan plan, double low, double high) {
  const auto grows = [&](double stiffness) {
    plan.plate.stiffness_n_per_mm = stiffness;
    ClosedLoop loop = restingLoop(plan, kPushN);
    const Vec3 push = loop.hand().goal.push;
    double early = 0.0;
    double late = 0.0;
    for (std::size_t k = 0; k < toTicks(plan, 1.9); ++k) {
      const double time_s = static_cast<double>(k) / plan.ticks_per_s;
      loop.hand().goal.push = push - (time_s < 0.004 ? Vec3(0, 0, 0.05 * kPushN) : Vec3(0, 0, 0));
      loop.tick();
      const double away = std::abs(loop.hand().place().z() + kPushN / stiffness);
      if (time_s > 0.1 && time_s < 0.6) early = std::max(early, away);
      if (time_s > 1.4) late = std::max(late, away);
    }
    return late > early;
  };
  for (int i = 0; i < 9; ++i) {
    const double middle = std::sqrt(low * high);
    (grows(middle) ? high : low) = middle;
  }
  return std::sqrt(low * high);
}

TapResult tap(const LoopPlan& plan, double speed_mm_per_s, double phase) {
  constexpr double kFrom = 4.0;
  constexpr double kGoal = -3.0;
  LoopSettings settings = makeLoopSettings(plan);
  settings.hand.start.z() = kFrom + phase * speed_mm_per_s / plan.ticks_per_s;
  ClosedLoop loop(settings);
  device::SimulatedHand& hand = loop.hand();
  hand.setVelocity({0.0, 0.0, -speed_mm_per_s});
  hand.goal.velocity.z() = -speed_mm_per_s;
  if (!(plan.hand.mass_kg > 0.0)) hand.goal.push.z() = -kPushN;
  TapResult result;
  bool touching = false;
  int contacts = 0;
  double before = 0.0;
  for (std::size_t k = 0; k < toTicks(plan, 0.6); ++k) {
    if (hand.goal.place.z() <= kGoal) hand.goal.velocity.setZero();
    const trace::Sample& sample = loop.tick();
    const bool touches = sample.contact.touch != contact::Touch::free;
    if (touches && !touching) ++contacts;
    touching = touches;
    const double force = sample.device_force.norm();
    if (contacts == 1 && result.first_force_n == 0.0) result.first_force_n = force;
    result.greatest_step_n = std::max(result.greatest_step_n, force - before);
    before = force;
    result.port_energy_mj = std::max(result.port_energy_mj, hand.energy().given());
  }
  result.bounces = std::max(0, contacts - 1);
  return result;
}

PressResult press(const LoopPlan& plan) {
  constexpr double kTremorMm = 0.1;
  constexpr double kTremorHz = 9.0;
  const double light_n = 0.02 * std::min(kFirmN, kDeepestPressMm * plan.plate.stiffness_n_per_mm);
  const double firm_n =
      std::min({kFirmN, kFirmShare * plan.device.force_n, kDeepestPressMm * plan.plate.stiffness_n_per_mm});
  ClosedLoop loop = restingLoop(plan, light_n);
  device::SimulatedHand& hand = loop.hand();
  const device::HandGoal light = pressing(plan, light_n);
  const device::HandGoal firm = pressing(plan, firm_n);
  HighPass filter(20.0, loop.tickS());
  Rms noise;
  Slope slope;
  std::size_t damped = 0;
  double lost = 0.0;
  double put_in = 0.0;
  double depth_before = -hand.place().z();
  double force_before = 0.0;
  for (std::size_t k = 0; k < toTicks(plan, 4.0); ++k) {
    const double time_s = static_cast<double>(k) / plan.ticks_per_s;
    // No two presses end at the same place: else one count of the encoder would be the bias of all.
    const double share = (0.9 + 0.05 * std::floor(time_s)) * 0.5 * (1.0 - std::cos(kTwoPi * time_s));
    hand.goal.place = (1.0 - share) * light.place + share * firm.place;
    hand.goal.push = (1.0 - share) * light.push + share * firm.push;
    hand.goal.place.z() += kTremorMm * std::sin(kTwoPi * kTremorHz * time_s);
    damped += (loop.tick().safety & servo::kDamped) != 0 ? 1 : 0;
    const double force = hand.motorForce().z();
    const double depth = -hand.place().z();
    const double above = filter(force);
    if (time_s >= 1.0) {
      noise.add(above);
      if (depth > 0.0) slope.add(depth, force);
      const double work = 0.5 * (force + force_before) * (depth - depth_before);
      lost += work;
      put_in += std::max(0.0, work);
    }
    depth_before = depth;
    force_before = force;
  }
  PressResult result;
  result.slope_n_per_mm = slope.value();
  result.stiffness_bias = result.slope_n_per_mm / plan.plate.stiffness_n_per_mm - 1.0;
  result.hysteresis = lost / put_in;
  result.damped_share = static_cast<double>(damped) / static_cast<double>(toTicks(plan, 4.0));
  result.noise_n = noise.value();
  return result;
}

SlideResult slide(const LoopPlan& plan) {
  constexpr double kAmplitude = 20.0;
  constexpr double kHz = 0.75;
  const double middle = 0.5 * plan.plate.blend_mm;
  ClosedLoop loop = restingLoop(plan, kPushN, middle - kAmplitude);
  device::SimulatedHand& hand = loop.hand();
  const device::HandGoal goal = hand.goal;
  HighPass filter(20.0, loop.tickS());
  Rms noise;
  SlideResult result;
  double energy_at_start = 0.0;
  Vec3 before = Vec3::Zero();
  for (std::size_t k = 0; k < toTicks(plan, 3.4); ++k) {
    const double time_s = static_cast<double>(k) / plan.ticks_per_s;
    const double moving_s = std::max(0.0, time_s - 0.4);
    hand.goal.place = goal.place;
    hand.goal.place.x() = middle - kAmplitude * std::cos(kTwoPi * kHz * moving_s);
    const trace::Sample& sample = loop.tick();
    const double above = filter(hand.motorForce().z());
    if (time_s < 0.4) {
      energy_at_start = hand.energy().given();
    } else {
      noise.add(above);
      result.greatest_step_n = std::max(result.greatest_step_n, (sample.device_force - before).norm());
      result.port_energy_mj = std::max(result.port_energy_mj, hand.energy().given() - energy_at_start);
    }
    before = sample.device_force;
  }
  result.noise_n = noise.value();
  return result;
}

}  // namespace palpate::lab
