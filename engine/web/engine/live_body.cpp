// A target becomes a tip by the viewer's own MouseFinger, so a press begins above the skin and never steps.
#include "engine/live_body.h"

#include <cmath>
#include <utility>

#include "palpate/contact/pressure_field.h"

namespace palpate::web {

namespace {

std::vector<contact::FingerSettings> pageFingers(const scene::Scene& scene) {
  scene::Finger finger;
  finger.radius_mm = kRadiusMm;
  return std::vector<contact::FingerSettings>(kFingers, scene::contactSettings(scene, finger));
}

}  // namespace

std::vector<scene::LumpSettings> presetLumps() {
  std::vector<scene::LumpSettings> lumps(3);
  lumps[0] = {.name = "soft", .at = "L2 left 35 mm", .depth_mm = 8.0, .diameter_mm = 12.0, .stiffness_ratio = 4.0};
  lumps[1] = {.name = "hard", .at = "L2 right 40 mm", .depth_mm = 4.0, .stiffness_ratio = 15.0};
  lumps[2] = {.name = "mobile", .at = "L4 right 40 mm", .depth_mm = 4.0, .stiffness_ratio = 15.0};
  lumps[2].mobility_mm_per_n = 20.0;
  return lumps;
}

LiveBody::LiveBody(std::shared_ptr<const scene::World> world) : simulator_(world, pageFingers(world->scene)) {}

void LiveBody::setDysfunctions(std::vector<maps::Dysfunction> dysfunctions) {
  scene::Scene scene = world().scene;
  scene.dysfunctions = std::move(dysfunctions);
  simulator_.change(scene::rebuiltOnItsSkin(world(), scene));
}

void LiveBody::setLumps(std::vector<scene::LumpSettings> lumps) {
  scene::Scene scene = world().scene;
  scene.lumps = std::move(lumps);
  simulator_.change(scene::rebuiltOnItsSkin(world(), scene));
}

bool LiveBody::pad(std::size_t finger, std::span<double> kpa) const noexcept {
  if (!world().pressure || finger >= kFingers) return false;
  const auto side = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(kpa.size()))));
  contact::pressureField(*world().pressure, world().surface.lumps.get(), felt(finger), {.taxels = side}, kpa);
  return true;
}

void LiveBody::aim(std::size_t finger, device::FingerTarget target) {
  if (finger >= kFingers) return;
  target.present = target.present && target.place.allFinite() && target.normal.allFinite();
  target.radius_mm = kRadiusMm;
  at_work_[finger].target = target;
}

void LiveBody::run(std::size_t ticks) noexcept {
  for (std::size_t i = 0; i < ticks; ++i, ++tick_) {
    for (std::size_t f = 0; f < kFingers; ++f) {
      Finger& finger = at_work_[f];
      const device::FingerStep step = finger.path.step(finger.target, finger.felt.force);
      if (step.jumped) simulator_.lift(f);
      finger.felt = simulator_.feel(f, step.tip);
      if (finger.target.present) recording_.add(tick_, f, finger.felt);
    }
  }
}

void LiveBody::packFrame(FramePacker& frame, bool all) {
  const deform::DeformedSurface& skin = simulator_.skin();
  all ? frame.packAll(skin) : frame.pack(skin);
}

void LiveBody::restartRecording() {
  recording_ = Recording();
  tick_ = 0;
}

}  // namespace palpate::web
