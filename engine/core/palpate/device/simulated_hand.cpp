// Sources of the hands: stylus, three directions: Fu and Cavusoglu 2012 (15 people, grip of 1 to 3 N), as quoted by
// others; arm: one fitted trial of a study of arm dynamics, 2015; thimble: assumed, of the size that Hajian and Howe
// 1997 report. A hand below about 8 Hz is active: that part is its goal, not its mechanics.
#include "palpate/device/simulated_hand.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpate::device {

namespace {

/// 1 kg = 1e-3 N s^2/mm.
constexpr double kHandKilogram = 1e-3;

double rounded(double value, double step) { return step > 0.0 ? std::round(value / step) * step : value; }

Vec3 rounded(const Vec3& v, double step) { return {rounded(v.x(), step), rounded(v.y(), step), rounded(v.z(), step)}; }

Vec3 saturated(const Vec3& force, double most) {
  const double length = force.norm();
  return length > most ? Vec3(force * (most / length)) : force;
}

}  // namespace

HandModel handModel(HandKind kind) {
  switch (kind) {
    case HandKind::stylus_x:
      return {0.218, 78.75e-3, 4.645e-3, 379.5e-3, 1.839e-3};
    case HandKind::stylus_y:
      return {0.269, 105.3e-3, 6.430e-3, 552.4e-3, 3.609e-3};
    case HandKind::stylus_z:
      return {0.204, 271.7e-3, 18.06e-3, 769.9e-3, 0.776e-3};
    case HandKind::thimble:
      return {0.006, 200e-3, 2.0e-3, 0.0, 0.0};
    case HandKind::arm:
      return {0.554, 135e-3, 6.45e-3, 0.0, 0.0};
    case HandKind::dead_load:
    case HandKind::released:
      return {};
  }
  return {};
}

SimulatedHand::SimulatedHand(const SimulatedHandSettings& settings) : settings_(settings), random_(settings.seed) {
  settings_.steps_per_tick = std::max(40, settings.steps_per_tick);
  step_s_ = settings.tick_s / settings_.steps_per_tick;
  const bool rigid = !(settings.hand.grip_n_per_mm > 0.0);
  device_mass_ = kHandKilogram * (settings.device.mass_kg + (rigid ? settings.hand.mass_kg : 0.0));
  hand_mass_ = rigid ? 0.0 : kHandKilogram * settings.hand.mass_kg;
  device_.place = hand_.place = goal.place = settings.start;
}

void SimulatedHand::setVelocity(const Vec3& velocity) { device_.velocity = hand_.velocity = velocity; }

Vec3 SimulatedHand::readTip() noexcept {
  return settings_.quantised ? rounded(device_.place, settings_.device.encoder_mm) : device_.place;
}

void SimulatedHand::writeForce(const Vec3& force) noexcept {
  const auto steps = static_cast<double>(settings_.steps_per_tick);
  const Vec3 bounded = saturated(rounded(force, settings_.force_step_n), settings_.device.force_n);
  newest_ = (newest_ + 1) % kCommands;
  commands_[newest_] = {step_ + std::llround(settings_.delay_ticks * steps), bounded};
  const std::int64_t shift =
      settings_.jitter_ticks > 0.0
          ? std::llround(random_.uniform(-settings_.jitter_ticks, settings_.jitter_ticks) * steps)
          : 0;
  const std::int64_t until = step_ + settings_.steps_per_tick + shift - std::exchange(shift_, shift);
  while (step_ < until) step();
}

/// The newest command that has arrived.
Vec3 SimulatedHand::commandNow() noexcept {
  while (at_work_ != newest_ && commands_[(at_work_ + 1) % kCommands].from_step <= step_) {
    at_work_ = (at_work_ + 1) % kCommands;
  }
  return commands_[at_work_].force;
}

/// Everything on the device but its own friction, N; moves the hand on.
Vec3 SimulatedHand::onDevice() noexcept {
  const HandModel& model = settings_.hand;
  Vec3 force = motor_ + goal.push;
  if (!(model.mass_kg > 0.0)) return force;
  const Vec3 place = goal.place;
  goal.place += goal.velocity * step_s_;
  const Body& held = hand_mass_ > 0.0 ? hand_ : device_;
  const Vec3 arm =
      model.stiffness_n_per_mm * (place - held.place) + model.damping_n_s_per_mm * (goal.velocity - held.velocity);
  if (!(hand_mass_ > 0.0)) return force + arm;
  const Vec3 grip = model.grip_n_per_mm * (hand_.place - device_.place) +
                    model.grip_damping_n_s_per_mm * (hand_.velocity - device_.velocity);
  hand_.velocity += (arm - grip) * (step_s_ / hand_mass_);
  hand_.place += hand_.velocity * step_s_;
  return force + grip;
}

/// Coulomb friction removes this much velocity, or all there is: it sticks exactly.
Vec3 SimulatedHand::slowed(const Vec3& velocity) noexcept {
  const double most = settings_.device.friction_n * step_s_ / device_mass_;
  if (settings_.shared_friction) {
    const double speed = velocity.norm();
    return velocity * (speed > most ? 1.0 - most / speed : 0.0);
  }
  const auto one = [most](double v) { return v > most ? v - most : v < -most ? v + most : 0.0; };
  return {one(velocity.x()), one(velocity.y()), one(velocity.z())};
}

void SimulatedHand::step() noexcept {
  const Vec3 command = commandNow();
  const double share = settings_.amplifier_lag_s > 0.0 ? std::min(1.0, step_s_ / settings_.amplifier_lag_s) : 1.0;
  motor_ += share * (command - motor_);
  const Vec3 damping = settings_.device.damping_n_s_per_mm * device_.velocity;
  const Vec3 pushed = device_.velocity + (onDevice() - damping) * (step_s_ / device_mass_);
  device_.velocity = slowed(pushed);
  const Vec3 motion = device_.velocity * step_s_;
  device_.place += motion;
  motor_work_ += motor_.dot(motion);
  friction_work_ += (damping + (pushed - device_.velocity) * (device_mass_ / step_s_)).dot(motion);
  ++step_;
}

PortEnergy SimulatedHand::energy() const noexcept {
  return {motor_work_, friction_work_, 0.5 * device_mass_ * device_.velocity.squaredNorm()};
}

Device simulatedHandDevice(std::string name, SimulatedHand& hand) {
  Device device;
  device.name = std::move(name);
  device.read_tip = [&hand](std::uint64_t) { return hand.readTip(); };
  device.write_force = [&hand](const Vec3& force) { hand.writeForce(force); };
  return device;
}

}  // namespace palpate::device
