// A pose crosses with the number of times its finger was put down or lifted: when the servo sees another number the
// finger forgets its contact, so the way between is never dragged through the body. The skin's world is kept until the
// skin of the next one is made, on the owner's thread.
#include "palpate/engine/live_simulator.h"

#include <fmt/format.h>

#include <utility>

#include "palpate/device/mouse_finger.h"

namespace palpate::engine {

namespace {

std::vector<contact::FingerSettings> fingersFor(const scene::World& world, std::vector<contact::FingerSettings> given) {
  return given.empty() ? fingerSettings(world.scene) : std::move(given);
}

}  // namespace

LiveSimulator::Link::Link() : pose(Pose{device::kNowhere, 0}), tip(device::kNowhere) {}

LiveSimulator::LiveSimulator(std::shared_ptr<const scene::World> world, std::vector<contact::FingerSettings> fingers)
    : fingers_(fingersFor(*world, std::move(fingers))),
      links_(std::make_unique<Link[]>(fingers_.size())),
      newest_world_(world),
      servo_(servoPlan(std::move(world), fingers_), collectDevices({links_.get(), fingers_.size()}),
             makeGuide({links_.get(), fingers_.size()})) {}

std::vector<device::Device> LiveSimulator::collectDevices(std::span<Link> links) {
  std::vector<device::Device> devices;
  for (Link& link : links) {
    device::Device device;
    device.name = fmt::format("finger_{}", devices.size() + 1);
    device.read_tip = [&link](std::uint64_t) { return link.tip; };
    devices.push_back(std::move(device));
  }
  return devices;
}

ServoThread::Guide LiveSimulator::makeGuide(std::span<Link> links) {
  return [links](std::span<servo::FingerChain> fingers) {
    for (std::size_t i = 0; i < links.size(); ++i) {
      const Pose& pose = links[i].pose.newest();
      if (std::exchange(links[i].placing_felt, pose.placing) != pose.placing) forgetTouch(fingers[i]);
      links[i].tip = pose.tip;
    }
  };
}

void LiveSimulator::move(std::size_t finger, const Vec3& tip) noexcept {
  Link& link = links_[finger];
  if (!std::exchange(link.present, true)) ++link.placing;
  link.pose.publish({tip, link.placing});
}

void LiveSimulator::lift(std::size_t finger) noexcept {
  Link& link = links_[finger];
  if (std::exchange(link.present, false)) ++link.placing;
  link.pose.publish({device::kNowhere, link.placing});
}

const deform::DeformedSurface& LiveSimulator::skin() {
  servo_.exchange();
  if (skin_world_ != servo_.world()) {
    skin_.emplace(*servo_.world(), LivingSkinSettings{.fingers = fingers_.size()});
    skin_world_ = servo_.world();
  }
  skin_->follow(felt());
  return skin_->surface();
}

void LiveSimulator::change(std::shared_ptr<const scene::World> world) {
  ServoPlan plan = servoPlan(world, fingers_);
  plan.other_body = !sameBody(*newest_world_, *world);
  newest_world_ = std::move(world);
  servo_.change(std::move(plan));
}

const scene::World& LiveSimulator::world() {
  servo_.exchange();
  return *servo_.world();
}

}  // namespace palpate::engine
