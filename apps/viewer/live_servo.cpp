#include "apps/viewer/live_servo.h"

#include <algorithm>
#include <utility>

#include "palpate/device/device_profile.h"
#include "palpate/servo/device_limits.h"

namespace palpate::viewer {

namespace {

/// A fingertip: what a mouse finger is when the scene does not say.
constexpr double kFingertipMm = 8.0;

/// A mouse pushes nobody's hand, so its force is neither shortened nor softened: what is shown is what the skin gives.
void removeLimits(servo::LimiterSettings& settings) { settings.limited = false; }

std::vector<device::Device> devicesOf(std::array<device::MouseLink, kFingers>& links,
                                      std::span<const device::Device> held) {
  std::vector<device::Device> devices;
  for (std::size_t i = 0; i < kFingers; ++i) {
    devices.push_back(i < held.size() ? held[i] : device::mouseDevice(std::string(kFingerNames[i]), links[i]));
  }
  return devices;
}

engine::ServoThread::Guide guideOf(std::array<device::MouseLink, kFingers>& links, std::size_t held) {
  return [&links, held](std::span<servo::FingerChain> fingers) {
    for (std::size_t i = held; i < kFingers; ++i) {
      if (device::advance(links[i])) engine::forgetTouch(fingers[i]);
    }
  };
}

}  // namespace

double fingerRadius(const scene::Scene& scene, std::size_t finger) {
  if (scene.contact.source == scene::ContactSource::hdb) return 0.0;  // it knows points only
  if (finger >= scene.fingers.size() || scene.fingers[finger].radius_mm <= 0.0) return kFingertipMm;
  return scene.fingers[finger].radius_mm;
}

engine::ServoPlan planFor(std::shared_ptr<const scene::World> world, const scene::Scene& scene, bool other_body,
                          const std::optional<device::Capabilities>& held) {
  std::vector<contact::FingerSettings> fingers;
  for (std::size_t i = 0; i < kFingers; ++i) {
    scene::Finger finger;
    finger.radius_mm = fingerRadius(scene, i);
    fingers.push_back(scene::contactSettings(scene, finger));
  }
  engine::ServoPlan plan = engine::servoPlan(std::move(world), std::move(fingers));
  if (held) {
    plan.limiter = servo::limiterSettings(*plan.world, device::profileOf(scene.safety.device, *held));
  } else {
    removeLimits(plan.limiter);
  }
  plan.other_body = other_body;
  return plan;
}

std::optional<device::Capabilities> leastOf(std::span<const device::Device> devices) {
  if (devices.empty()) return std::nullopt;
  device::Capabilities least;
  const auto lower = [](double& value, double other) {
    if (other > 0.0) value = value > 0.0 ? std::min(value, other) : other;
  };
  for (const device::Device& device : devices) {
    lower(least.max_force_n, device.capabilities.max_force_n);
    lower(least.nominal_stiffness_n_per_mm, device.capabilities.nominal_stiffness_n_per_mm);
  }
  return least;
}

LiveServo::LiveServo(engine::ServoPlan plan, std::vector<device::Device> devices)
    : devices_(std::move(devices)),
      thread_(std::move(plan), devicesOf(links_, devices_), guideOf(links_, devices_.size())) {}

}  // namespace palpate::viewer
