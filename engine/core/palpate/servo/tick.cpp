// device pose -> guardTip -> touch -> limitForce -> device force, for one finger after the other.
#include "palpate/servo/tick.h"

#include <utility>

namespace palpate::servo {

namespace {

/// A device that names its rate has a pose in each of its ticks or is in trouble. Another program comes when it comes,
/// and has no position when that is too long ago.
double poseAge(const device::Device& device, const device::DeviceState& state) noexcept {
  return device.capabilities.rate_hz > 0.0 ? static_cast<double>(state.age_ticks) : 0.0;
}

/// Also by the button of the device itself.
bool isStopped(EmergencyStop* stop, const device::DeviceState& state) noexcept {
  if (stop == nullptr) return false;
  if (state.stops) stop->press();
  return stop->pressed();
}

void runFinger(FingerChain& finger, LoopEvent event, EmergencyStop* stop, trace::Sample& sample) noexcept {
  Pose pose;
  pose.tip = finger.device.read_tip(sample.tick);
  const device::DeviceState state = finger.device.state ? finger.device.state() : device::DeviceState{};
  pose.tick = sample.tick;
  pose.age_ticks = poseAge(finger.device, state);
  const Vec3 tip = guardTip(finger.limiter_settings, finger.limiter, pose);
  if (event == LoopEvent::stalled) reportFault(finger.limiter, kStalled);
  if (isStopped(stop, state)) reportFault(finger.limiter, kEmergencyStop);
  if (state.clutched) reportFault(finger.limiter, kClutched);
  if (state.elsewhere) forgetTouch(finger);
  sample.contact = touch(finger.solver, finger.contact_settings, finger.contact, tip, sample.tick);
  sample.device_force =
      limitForce(finger.limiter_settings, finger.limiter, sample.contact, finger.solver.source.surface->force_law);
  sample.safety = finger.limiter.status;
  sample.loss_n_mm = finger.limiter.passivity.loss_n_mm;
  sample.forgot = std::exchange(finger.forgot, 0u);
  sample.buttons = state.buttons;
  if (finger.device.write_force) finger.device.write_force(sample.device_force);
}

}  // namespace

void forgetTouch(FingerChain& finger) noexcept {
  lift(finger.solver, finger.contact);
  finger.forgot |= trace::kForgotTouch;
}

void giveDevice(FingerChain& finger, device::Device device) {
  finger.limiter.closes_loop = static_cast<bool>(device.write_force);
  finger.device = std::move(device);
}

void exchangeDevice(FingerChain& finger, device::Device& device) noexcept {
  if (finger.device.write_force) finger.device.write_force(Vec3::Zero());
  std::swap(finger.device, device);
  finger.limiter = {};
  finger.limiter.closes_loop = static_cast<bool>(finger.device.write_force);
  finger.forgot |= trace::kForgotLimiter;
  forgetTouch(finger);
}

Rig rigOf(RigParts parts) {
  Rig rig;
  rig.tick_s = parts.tick_s;
  parts.limiter.tick_s = parts.tick_s;
  for (std::size_t i = 0; i < parts.fingers.size(); ++i) {
    FingerChain chain;
    chain.solver = std::move(parts.solvers[i]);
    chain.contact_settings = parts.fingers[i];
    chain.contact_settings.tick_s = parts.tick_s;
    chain.limiter_settings = parts.limiter;
    giveDevice(chain, std::move(parts.devices[i]));
    rig.fingers.push_back(std::move(chain));
  }
  return rig;
}

void runTick(Rig& rig, std::uint64_t tick, LoopEvent event, std::span<trace::Sample> samples) noexcept {
  for (std::size_t i = 0; i < rig.fingers.size(); ++i) {
    samples[i].tick = tick;
    samples[i].finger = static_cast<std::uint32_t>(i);
    samples[i].world = rig.world;
    runFinger(rig.fingers[i], event, rig.emergency_stop, samples[i]);
  }
}

}  // namespace palpate::servo
