// A target becomes a tip by the viewer's own MouseFinger, so a press begins above the skin and never steps.
#include "engine/live_body.h"

#include <utility>

namespace palpate::web {

namespace {

std::vector<contact::FingerSettings> pageFingers(const scene::Scene& scene) {
  scene::Finger finger;
  finger.radius_mm = kRadiusMm;
  return std::vector<contact::FingerSettings>(kFingers, scene::contactSettings(scene, finger));
}

}  // namespace

LiveBody::LiveBody(std::shared_ptr<const scene::World> world) : simulator_(world, pageFingers(world->scene)) {}

void LiveBody::setDysfunctions(std::vector<maps::Dysfunction> dysfunctions) {
  scene::Scene scene = world().scene;
  scene.dysfunctions = std::move(dysfunctions);
  simulator_.change(scene::rebuilt(world(), scene));
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

void LiveBody::recordAnew() {
  recording_ = Recording();
  tick_ = 0;
}

}  // namespace palpate::web
