#include "view/viewer/files/scene_snippet.h"

#include <fmt/format.h>

#include <cmath>

#include "palpate/scene/scene_writer.h"
#include "view/viewer/world/live_servo.h"

namespace palpate::viewer {

namespace {

double inHundredths(double value) { return std::round(100.0 * value) / 100.0; }

scene::Finger asPressed(const contact::FingerOutput& contact, const std::string& name, double radius_mm) {
  scene::Finger finger;
  finger.name = name;
  finger.radius_mm = radius_mm;
  finger.at_mm = Vec2(inHundredths(contact.proxy.x()), inHundredths(contact.proxy.y()));
  finger.steps = {{.move = scene::Move::press, .depth_mm = inHundredths(contact.depth_mm)},
                  {.move = scene::Move::hold}};
  return finger;
}

}  // namespace

std::string sceneSnippet(const EditedScene& edited, const BodyView& seen) {
  scene::Scene scene = sceneToSave(edited.scene, seen);
  storeCamera(seen, scene.view);
  std::string head = fmt::format("# {}\n", edited.world.name);
  std::vector<scene::Finger> pressed;
  for (std::size_t i = 0; i < kFingers; ++i) {
    const contact::FingerOutput& contact = seen.fingers[i];
    if (!seen.finger_present[i] || contact.touch == contact::Touch::free) continue;
    const std::string name = i == 0 ? "left" : "right";
    pressed.push_back(asPressed(contact, name, fingerRadius(edited.scene, i)));
    const Vec3& force = contact.force;
    head += fmt::format("# {}: {:.2f} mm deep, {:.3f} N (x {:.3f}, y {:.3f}, z {:.3f}) at {:.1f}, {:.1f}, {:.1f} mm\n",
                        name, contact.depth_mm, force.norm(), force.x(), force.y(), force.z(), contact.proxy.x(),
                        contact.proxy.y(), contact.proxy.z());
  }
  if (!pressed.empty()) scene.fingers = std::move(pressed);
  return head + scene::sceneAsToml(scene);
}

}  // namespace palpate::viewer
