#include "view/viewer/world/live_servo.h"

#include <utility>

#include "palpate/device/device_profile.h"
#include "palpate/servo/device_limits.h"

namespace palpate::viewer {

namespace {

/// Default radius of a mouse finger: a fingertip's.
constexpr double kFingertipMm = 8.0;

/// A mouse pushes no hand, so its force is neither shortened nor softened: the window shows the skin's own force.
void removeLimits(servo::LimiterSettings& settings) { settings.limited = false; }

}  // namespace

double fingerRadius(const scene::Scene& scene, std::size_t finger) {
  if (scene.contact.source == scene::ContactSource::hdb) return 0.0;  // it supports points only
  if (finger >= scene.fingers.size() || scene.fingers[finger].radius_mm <= 0.0) return kFingertipMm;
  return scene.fingers[finger].radius_mm;
}

engine::ServoPlan planFor(std::shared_ptr<const scene::World> world, const scene::Scene& scene, bool other_body,
                          std::span<const device::Capabilities> held, double tick_s) {
  std::vector<contact::FingerSettings> fingers;
  for (std::size_t i = 0; i < kFingers; ++i) {
    scene::Finger finger;
    finger.radius_mm = fingerRadius(scene, i);
    fingers.push_back(scene::contactSettings(scene, finger));
  }
  engine::ServoPlan plan = engine::servoPlan(std::move(world), std::move(fingers));
  if (!held.empty()) {
    plan.limiter = servo::limiterSettings(*plan.world, device::profileOf(scene.safety.device, held), tick_s);
  } else {
    removeLimits(plan.limiter);
  }
  plan.other_body = other_body;
  return plan;
}

device::Capabilities scaledCapabilities(const OpenedDevice& opened) {
  device::Capabilities able = opened.device.capabilities;
  able.motion_scale = opened.workspace.frame.mm;
  return able;
}

std::vector<device::Capabilities> scaledCapabilities(const std::vector<OpenedDevice>& devices) {
  std::vector<device::Capabilities> able;
  for (const OpenedDevice& opened : devices) able.push_back(scaledCapabilities(opened));
  return able;
}

LiveServo::Held LiveServo::heldBy(OpenedDevice opened) {
  auto link = std::make_shared<device::WorkspaceLink>(opened.workspace);
  device::Device placed = device::inWorkspace(opened.device, opened.workspace, link);
  return {std::move(opened), std::move(link), std::move(placed)};
}

LiveServo::LiveServo(engine::ServoPlan plan, std::vector<OpenedDevice> devices)
    : held_([&devices] {
        std::array<std::optional<Held>, kFingers> held;
        for (std::size_t i = 0; i < devices.size(); ++i) held[i] = heldBy(std::move(devices[i]));
        return held;
      }()),
      thread_(std::move(plan), devicesAtFirst(), guide()) {}

std::vector<device::Device> LiveServo::devicesAtFirst() {
  std::vector<device::Device> devices;
  for (std::size_t i = 0; i < kFingers; ++i) {
    devices.push_back(held_[i] ? held_[i]->placed : device::mouseDevice(std::string(kFingerNames[i]), mice_[i]));
  }
  return devices;
}

/// The mouse's fingers follow their path in any case; a device's state shows that it is not one of them.
engine::ServoThread::Guide LiveServo::guide() {
  return [this](std::span<servo::FingerChain> fingers) {
    for (std::size_t i = 0; i < kFingers; ++i) {
      if (device::advance(mice_[i]) && !fingers[i].device.state) engine::forgetTouch(fingers[i]);
    }
  };
}

void LiveServo::leave(std::size_t finger) {
  if (!held_[finger]) return;
  leaving_.push_back(std::move(held_[finger]->placed));
  leaving_.push_back(std::move(held_[finger]->opened.device));
  held_[finger].reset();
}

void LiveServo::hold(std::size_t finger, OpenedDevice opened, engine::ServoPlan plan) {
  leave(finger);
  held_[finger] = heldBy(std::move(opened));
  plan.devices.resize(kFingers);
  plan.devices[finger] = held_[finger]->placed;
  thread_.change(std::move(plan));
}

void LiveServo::release(std::size_t finger, engine::ServoPlan plan) {
  leave(finger);
  plan.devices.resize(kFingers);
  plan.devices[finger] = device::mouseDevice(std::string(kFingerNames[finger]), mice_[finger]);
  thread_.change(std::move(plan));
}

std::vector<device::Device> LiveServo::collectReleased() {
  if (leaving_.empty() || !thread_.settled()) return {};
  return std::exchange(leaving_, {});
}

std::vector<device::Capabilities> LiveServo::abilitiesWith(std::size_t finger, const OpenedDevice* opened) const {
  std::vector<device::Capabilities> devices;
  for (std::size_t i = 0; i < kFingers; ++i) {
    if (i != finger && held_[i]) devices.push_back(scaledCapabilities(held_[i]->opened));
  }
  if (opened != nullptr) devices.push_back(scaledCapabilities(*opened));
  return devices;
}

std::vector<device::Capabilities> LiveServo::abilities() const {
  return abilitiesWith(0, held_[0] ? &held_[0]->opened : nullptr);
}

bool LiveServo::place(std::size_t finger, const device::Workspace& workspace) {
  if (!held_[finger] || held_[finger]->opened.workspace == workspace) return false;
  Held& held = *held_[finger];
  held.opened.workspace = workspace;
  held.link->place(workspace);
  return true;
}

void LiveServo::clutch(std::size_t finger, bool held) {
  if (held_[finger]) held_[finger]->link->clutch(held);
}

device::WorkspaceReading LiveServo::reading(std::size_t finger) {
  return held_[finger] ? held_[finger]->link->reading() : device::WorkspaceReading{};
}

}  // namespace palpate::viewer
