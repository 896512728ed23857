// A plan is taken between two ticks by swapping solvers with the rig, so that objects that would have to be freed go
// back inside the plan before. One plan is offered at a time; the next waits with the owner, and a newer one in its
// place inherits its `other_body`, or a finger would go on touching triangles that are gone.
#include "palpate/engine/servo_thread.h"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/engine/fingers.h"
#include "palpate/servo/device_limits.h"

namespace palpate::engine {

namespace {

servo::Rig rigFor(ServoPlan& plan, std::vector<device::Device> devices, double tick_s) {
  if (devices.size() != plan.fingers.size()) {
    throw Error(
        fmt::format("servo: {} devices for {} fingers; expected one per finger", devices.size(), plan.fingers.size()));
  }
  return servo::rigOf({.solvers = std::exchange(plan.solvers, servo::FingerSolvers(devices.size())),
                       .fingers = plan.fingers,
                       .devices = std::move(devices),
                       .limiter = plan.limiter,
                       .tick_s = tick_s});
}

double tickLength(const ServoPlan& plan) {
  return plan.fingers.empty() ? servo::Rig{}.tick_s : plan.fingers.front().tick_s;
}

/// Catch-up, ramps and limits of speed are per second: all must mean the same second.
void setTickLength(ServoPlan& plan, double tick_s) {
  for (contact::FingerSettings& finger : plan.fingers) finger.tick_s = tick_s;
  plan.limiter.tick_s = tick_s;
}

/// Devices of a plan that was never adopted move to the same fingers of the plan that replaces it.
void inheritDevices(std::vector<std::optional<device::Device>>& devices, std::optional<ServoPlan>& waiting) {
  for (std::size_t i = 0; waiting && i < waiting->devices.size(); ++i) {
    if (!devices[i]) devices[i] = std::move(waiting->devices[i]);
  }
}

/// Puts the next plan into the rig, and objects that can only be freed elsewhere back into the one before.
void adopt(servo::Rig& rig, ServoPlan& before, ServoPlan& next) noexcept {
  for (std::size_t i = 0; i < rig.fingers.size(); ++i) {
    servo::FingerChain& finger = rig.fingers[i];
    servo::exchange(finger.solver, next.solvers[i], finger.contact);
    finger.contact_settings = next.fingers[i];
    finger.limiter_settings = next.limiter;
    if (next.other_body) forgetTouch(finger);
    if (i < next.devices.size() && next.devices[i]) servo::exchangeDevice(finger, *next.devices[i]);
  }
  std::swap(before.solvers, next.solvers);  // those that were at work
  std::swap(before.devices, next.devices);
  ++rig.world;
}

}  // namespace

ServoPlan servoPlan(std::shared_ptr<const scene::World> world, std::vector<contact::FingerSettings> fingers) {
  checkFingers(*world, fingers);
  ServoPlan plan;
  plan.limiter = servo::limiterSettings(*world);
  plan.solvers = servo::makeSolvers(world->surface, world->hdb, fingers.size(), world->breath);
  plan.fingers = std::move(fingers);
  plan.world = std::move(world);
  return plan;
}

ServoThread::ServoThread(ServoPlan plan, std::vector<device::Device> devices, Guide guide, std::size_t record_capacity)
    : fingers_(plan.fingers.size()),
      tick_s_(tickLength(plan)),
      links_(fingers_, std::size_t{1} << 16, record_capacity),
      guide_(std::move(guide)),
      at_work_(std::make_unique<ServoPlan>(std::move(plan))) {
  rig_ = rigFor(*at_work_, std::move(devices), tick_s_);
  at_work_world_ = at_work_->world;
  felt_ = {0, at_work_world_, feltWith(rig_)};
  servo::PacedSettings settings;
  settings.pacing.period_s = tick_s_;
  settings.before_tick = [this](servo::Rig& rig) { beforeTick(rig); };
  thread_ = std::thread([this, settings] {
    report_ = servo::runPaced(rig_, std::numeric_limits<std::uint64_t>::max(), settings, links_);
  });
}

ServoThread::~ServoThread() {
  if (thread_.joinable()) stop();
}

servo::LoopReport ServoThread::stop() {
  links_.stop = true;
  thread_.join();
  return report_;
}

void ServoThread::beforeTick(servo::Rig& rig) noexcept {
  handover_.receive(at_work_, [&rig](ServoPlan& before, ServoPlan& next) noexcept { adopt(rig, before, next); });
  if (guide_) guide_(rig.fingers);
}

void ServoThread::change(ServoPlan plan) {
  if (plan.fingers.size() != fingers_) {
    throw Error(fmt::format("servo: {} fingers; expected {}", plan.fingers.size(), fingers_));
  }
  setTickLength(plan, tick_s_);
  plan.devices.resize(fingers_);
  inheritDevices(plan.devices, waiting_);
  // A plan that was never taken may have been the one with another body.
  plan.other_body = plan.other_body || (waiting_ && waiting_->other_body);
  waiting_ = std::move(plan);
  advance();
}

bool ServoThread::exchange() {
  advance();
  return std::exchange(changed_, false);
}

void ServoThread::advance() {
  if (offered_world_ && handover_.collect()) {
    at_work_world_ = std::exchange(offered_world_, nullptr);
    felt_ = *std::exchange(felt_next_, std::nullopt);
    changed_ = true;
  }
  if (!waiting_ || offered_world_) return;
  felt_next_ = offeredWorld();
  if (listener_) listener_(*felt_next_);
  offered_world_ = waiting_->world;
  handover_.offer(std::make_unique<ServoPlan>(std::move(*waiting_)));
  waiting_.reset();
}

/// The waiting world, as `adopt` will have it.
FeltWorld ServoThread::offeredWorld() const {
  FeltWorld felt{felt_.number + 1, waiting_->world, {}};
  for (std::size_t i = 0; i < fingers_; ++i) {
    const std::optional<device::Device>& device = waiting_->devices[i];
    const bool closes_loop = device ? static_cast<bool>(device->write_force) : felt_.fingers[i].closes_loop;
    felt.fingers.push_back({waiting_->fingers[i], waiting_->limiter, closes_loop});
  }
  return felt;
}

void ServoThread::record(WorldListener listener) {
  listener_ = std::move(listener);
  if (listener_) {
    advance();
    listener_(felt_);
    if (felt_next_) listener_(*felt_next_);
  }
  links_.records.store(static_cast<bool>(listener_), std::memory_order_release);
}

}  // namespace palpate::engine
