#include "apps/viewer/live_servo.h"

namespace palpate::viewer {

namespace {

/// A fingertip: what a mouse finger is when the scene does not say.
constexpr double kFingertipMm = 8.0;

/// A mouse pushes nobody's hand, so its force is neither shortened nor ramped: what is shown is what the skin gives.
void removeLimits(servo::LimiterSettings& settings) {
  settings.safety.nominal_force_n = 1e4;
  settings.safety.ramp_s = 0.0;
  settings.safety.slew_mm = 1e3;
  settings.safety.passivity = false;
}

std::vector<device::Device> devicesOf(std::array<device::MouseLink, kFingers>& links) {
  return {device::mouseDevice(std::string(kFingerNames[0]), links[0]),
          device::mouseDevice(std::string(kFingerNames[1]), links[1])};
}

engine::ServoThread::Guide guideOf(std::array<device::MouseLink, kFingers>& links) {
  return [&links](std::span<servo::FingerChain> fingers) {
    for (std::size_t i = 0; i < kFingers; ++i) {
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

engine::ServoPlan planFor(std::shared_ptr<const scene::World> world, const scene::Scene& scene, bool other_body) {
  std::vector<contact::FingerSettings> fingers;
  for (std::size_t i = 0; i < kFingers; ++i) {
    scene::Finger finger;
    finger.radius_mm = fingerRadius(scene, i);
    fingers.push_back(scene::contactSettings(scene, finger));
  }
  engine::ServoPlan plan = engine::servoPlan(std::move(world), std::move(fingers));
  removeLimits(plan.limiter);
  plan.other_body = other_body;
  return plan;
}

LiveServo::LiveServo(engine::ServoPlan plan) : thread_(std::move(plan), devicesOf(links_), guideOf(links_)) {}

}  // namespace palpate::viewer
