// Place and depth follow by the closed form of critical damping, so any tick length is stable; the direction turns by a
// first-order lag. Press by force goes deeper by the missing force over the secant stiffness felt so far.
// Data flow: FingerTarget (60 Hz) and the force of the last tick -> here, at 1 kHz before the contact -> tip.
#include "palpate/device/mouse_finger.h"

#include <algorithm>
#include <utility>

#include "palpate/base/elementary.h"

namespace palpate::device {

namespace {

/// The stiffness assumed before one is felt, N/mm: the soft end of a back, so that the first approach is quick and
/// never hits hard.
constexpr double kSoftGuess = 0.3;
constexpr double kMinStiffness = 0.02;

/// One tick of a critically damped follower; exact for a target at rest, whatever the tick.
template <class T>
void follow(T& value, T& speed, const T& target, double rate, double tick_s) noexcept {
  const double decay = elementary::exp(-rate * tick_s);
  const T away = value - target;
  const T push = (speed + rate * away) * tick_s;
  speed = (speed - rate * push) * decay;
  value = target + (away + push) * decay;
}

}  // namespace

FingerStep MouseFinger::step(const FingerTarget& target, const Vec3& felt_force) noexcept {
  FingerStep step;
  if (!target.present) {
    step.jumped = std::exchange(present_, false);
    step.tip = kNowhere;
    return step;
  }
  step.jumped = mustJump(target);
  if (step.jumped) jump(target);
  follow<Vec3>(place_, place_speed_, target.place, settings_.place_rate, settings_.tick_s);
  turn(target);
  if (target.pressed && target.by == PressBy::force && depth_ > -0.5 * settings_.hover_mm) {
    pressByForce(target, felt_force);
  } else {
    const double wanted = target.pressed && target.by == PressBy::depth ? target.depth_mm
                          : target.pressed                              ? 0.0
                                                                        : -settings_.hover_mm;
    follow(depth_, depth_speed_, wanted, settings_.depth_rate, settings_.tick_s);
  }
  step.tip = place_ + (target.radius_mm - depth_) * normal_;
  return step;
}

bool MouseFinger::mustJump(const FingerTarget& target) const noexcept {
  if (!present_) return true;
  return depth_ < 0.0 && (target.place - place_).norm() > settings_.jump_mm;
}

void MouseFinger::jump(const FingerTarget& target) noexcept {
  present_ = true;
  place_ = target.place;
  place_speed_.setZero();
  normal_ = target.normal;
  depth_ = -settings_.hover_mm;
  depth_speed_ = 0.0;
}

void MouseFinger::turn(const FingerTarget& target) noexcept {
  const double constant_s = target.pressed ? settings_.turn_pressed_s : settings_.turn_free_s;
  const Vec3 turned = normal_ + (1.0 - elementary::exp(-settings_.tick_s / constant_s)) * (target.normal - normal_);
  const double length = turned.norm();
  if (length > 1e-6) normal_ = turned / length;
}

/// Newton's method in small steps: the stiffness felt so far gives the depth of the wanted force.
void MouseFinger::pressByForce(const FingerTarget& target, const Vec3& felt_force) noexcept {
  const double felt = felt_force.dot(normal_);
  const bool touches = felt > 0.0 && depth_ > 0.0;
  const double stiffness = touches ? std::max(kMinStiffness, felt / depth_) : kSoftGuess;
  const double missing = (target.force_n - std::max(0.0, felt)) / stiffness;
  depth_speed_ =
      std::clamp(missing / settings_.force_s, -settings_.max_depth_speed_mm_per_s, settings_.max_depth_speed_mm_per_s);
  depth_ = std::clamp(depth_ + depth_speed_ * settings_.tick_s, -settings_.hover_mm, target.max_depth_mm);
}

bool advance(MouseLink& link) noexcept {
  const FingerStep step = link.finger.step(link.target.newest(), link.felt_force);
  link.tip = step.tip;
  return step.jumped;
}

device::Device mouseDevice(std::string name, MouseLink& link) {
  device::Device device;
  device.name = std::move(name);
  device.read_tip = [&link](std::uint64_t) { return link.tip; };
  device.write_force = [&link](const Vec3& force) { link.felt_force = force; };
  return device;
}

}  // namespace palpate::device
