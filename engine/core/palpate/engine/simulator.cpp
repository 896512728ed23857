// A tick is one Finger::feel, without the limiter that a hand on a device needs. A change of world does all that can
// throw first.
#include "palpate/engine/simulator.h"

#include <algorithm>
#include <utility>

#include "palpate/contact/felt_force.h"

namespace palpate::engine {

namespace {

/// The answer for a finger that there is not.
contact::FingerOutput missingFingerOutput(const Vec3& tip) noexcept {
  contact::FingerOutput output = contact::freeOutput(tip);
  output.status = contact::kTipLost;
  return output;
}

}  // namespace

Simulator::Simulator(std::shared_ptr<const scene::World> world, std::vector<contact::FingerSettings> fingers)
    : world_(std::move(world)) {
  if (fingers.empty()) fingers = fingerSettings(world_->scene);
  checkFingers(*world_, fingers);
  fingers_ = makeRig(*world_, fingers);
  felt_.resize(fingers.size());
}

contact::FingerOutput Simulator::feel(std::size_t finger, const Vec3& tip) noexcept {
  if (finger >= fingers_.size()) return missingFingerOutput(tip);
  return felt_[finger] = fingers_[finger].feel(tip);
}

void Simulator::feel(std::span<const Vec3> tips, std::span<contact::FingerOutput> felt) noexcept {
  const std::size_t count = std::min(tips.size(), felt.size());
  for (std::size_t i = 0; i < count; ++i) felt[i] = feel(i, tips[i]);
}

void Simulator::lift(std::size_t finger) noexcept {
  if (finger >= fingers_.size()) return;
  fingers_[finger].lift();
  felt_[finger] = contact::freeOutput(felt_[finger].tip);
}

const deform::DeformedSurface& Simulator::skin() {
  if (!skin_) skin_.emplace(*world_, LivingSkinSettings{.fingers = fingers_.size()});
  skin_->follow(felt_, fingers_.front().ticks == 0 ? 0 : fingers_.front().ticks - 1);
  return skin_->surface();
}

void Simulator::change(std::shared_ptr<const scene::World> world) {
  std::vector<contact::FingerSettings> settings;
  for (const Finger& finger : fingers_) settings.push_back(finger.settings);
  checkFingers(*world, settings);
  servo::FingerSolvers solvers = servo::makeSolvers(world->surface, world->hdb, fingers_.size(), world->breath);
  const bool same_body = sameBody(*world_, *world);
  skin_.reset();
  world_ = std::move(world);
  for (std::size_t i = 0; i < fingers_.size(); ++i) {
    servo::exchange(fingers_[i].solver, solvers[i], fingers_[i].state);
    if (!same_body) lift(i);
  }
}

}  // namespace palpate::engine
