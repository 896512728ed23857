// device pose -> guardTip -> touch -> limitForce -> device force, for one finger after the other. Own.
#include "palpate/servo/tick.h"

#include <utility>

namespace palpate::servo {

namespace {

void runFinger(FingerChain& finger, LoopEvent event, trace::Sample& sample) noexcept {
  const Vec3 measured = finger.device.read_tip(sample.tick);
  const Vec3 tip = guardTip(finger.limiter_settings, finger.limiter, measured);
  if (event == LoopEvent::stalled) restartRamp(finger.limiter, kStalled);
  sample.contact = touch(finger.solver, finger.contact_settings, finger.contact, tip);
  sample.device_force = limitForce(finger.limiter_settings, finger.limiter, sample.contact.force);
  sample.safety = finger.limiter.status;
  if (finger.device.write_force) finger.device.write_force(sample.device_force);
}

}  // namespace

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
    chain.device = std::move(parts.devices[i]);
    rig.fingers.push_back(std::move(chain));
  }
  return rig;
}

void runTick(Rig& rig, std::uint64_t tick, LoopEvent event, std::span<trace::Sample> samples) noexcept {
  for (std::size_t i = 0; i < rig.fingers.size(); ++i) {
    samples[i].tick = tick;
    samples[i].finger = static_cast<std::uint32_t>(i);
    runFinger(rig.fingers[i], event, samples[i]);
  }
}

}  // namespace palpate::servo
