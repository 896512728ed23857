#include "apps/viewer/live_servo.h"

#include <limits>

#include "palpate/servo/scripted_rig.h"

namespace palpate::viewer {

namespace {

/// A fingertip: what a mouse finger is when the scene does not say.
constexpr double kFingertipMm = 8.0;

/// A mouse pushes nobody's hand, so its force is neither shortened nor ramped: what is shown is what the skin gives.
servo::LimiterSettings withoutLimits(const scene::World& world) {
  servo::LimiterSettings settings = servo::limiterSettings(world);
  settings.safety.nominal_force_n = 1e4;
  settings.safety.ramp_s = 0.0;
  settings.safety.slew_mm = 1e3;
  settings.safety.passivity = false;
  return settings;
}

servo::Rig rigFor(RigPlan& plan, std::array<device::MouseLink, kFingers>& links) {
  servo::Rig rig;
  rig.tick_s = plan.fingers[0].tick_s;
  for (std::size_t i = 0; i < kFingers; ++i) {
    servo::FingerChain chain;
    chain.solver = std::move(plan.solvers[i]);
    chain.contact_settings = plan.fingers[i];
    chain.limiter_settings = plan.limiter;
    chain.device = device::mouseDevice(i == 0 ? "left" : "right", links[i]);
    rig.fingers.push_back(std::move(chain));
  }
  return rig;
}

}  // namespace

void forgetTouch(servo::FingerChain& finger) noexcept { finger.contact = {}; }

double radiusOf(const scene::Scene& scene, std::size_t finger) {
  if (scene.contact.source == scene::ContactSource::hdb) return 0.0;  // it knows points only
  if (finger >= scene.fingers.size() || scene.fingers[finger].radius_mm <= 0.0) return kFingertipMm;
  return scene.fingers[finger].radius_mm;
}

RigPlan planFor(std::shared_ptr<const scene::World> world, const scene::Scene& scene, bool other_body) {
  RigPlan plan;
  for (std::size_t i = 0; i < kFingers; ++i) {
    scene::Finger finger;
    finger.radius_mm = radiusOf(scene, i);
    plan.fingers[i] = scene::contactSettings(scene, finger);
    contact::check(plan.fingers[i]);
  }
  plan.limiter = withoutLimits(*world);
  plan.solvers = servo::makeSolvers(world->surface, world->hdb, kFingers);
  plan.other_body = other_body;
  plan.world = std::move(world);
  return plan;
}

LiveServo::LiveServo(RigPlan plan) : links_(kFingers), at_work_(std::make_unique<RigPlan>(std::move(plan))) {
  rig_ = rigFor(*at_work_, links_to_);
  servo::PacedSettings settings;
  settings.pacing.period_s = rig_.tick_s;
  settings.before_tick = [this](servo::Rig& rig) { beforeTick(rig); };
  thread_ = std::thread([this, settings] {
    report_ = servo::runPaced(rig_, std::numeric_limits<std::uint64_t>::max(), settings, links_);
  });
}

LiveServo::~LiveServo() {
  if (thread_.joinable()) stop();
}

servo::LoopReport LiveServo::stop() {
  links_.stop = true;
  thread_.join();
  return report_;
}

void LiveServo::beforeTick(servo::Rig& rig) noexcept {
  if (RigPlan* plan = offered_.load(std::memory_order_acquire); plan != nullptr) {
    for (std::size_t i = 0; i < kFingers; ++i) {
      servo::FingerChain& finger = rig.fingers[i];
      servo::exchange(finger.solver, plan->solvers[i], finger.contact);
      std::swap(finger.contact_settings, plan->fingers[i]);
      finger.limiter_settings = plan->limiter;
      if (plan->other_body) forgetTouch(finger);
    }
    // From here on nothing of the plan before is looked at.
    offered_.store(nullptr, std::memory_order_release);
  }
  for (std::size_t i = 0; i < kFingers; ++i) {
    if (device::advance(links_to_[i])) forgetTouch(rig.fingers[i]);
  }
}

void LiveServo::change(RigPlan plan) {
  // A plan that was never taken may have been the one with another body.
  plan.other_body = plan.other_body || (waiting_ && waiting_->other_body);
  waiting_ = std::move(plan);
}

bool LiveServo::exchange() {
  bool changed = false;
  if (offered_plan_ && offered_.load(std::memory_order_acquire) == nullptr) {
    at_work_ = std::move(offered_plan_);
    changed = true;
  }
  if (waiting_ && !offered_plan_) {
    offered_plan_ = std::make_unique<RigPlan>(std::move(*waiting_));
    waiting_.reset();
    offered_.store(offered_plan_.get(), std::memory_order_release);
  }
  return changed;
}

}  // namespace palpate::viewer
