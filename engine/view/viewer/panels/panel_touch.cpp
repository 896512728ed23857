// Press of the finger and friction of the skin.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "palpate/base/language.h"
#include "view/viewer/editing/pointer.h"
#include "view/viewer/panels/panels.h"
#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {

namespace {

constexpr auto kPressBy = enumNames<device::PressBy>();
constexpr std::array<std::string_view, kFingers> kFingerChoices = {toTranslate("left (blue)"),
                                                                   toTranslate("right (red)")};

void pressWidgets(TouchSettings& touch) {
  choiceWidget("touch/by", "press by", touch.by, kPressBy,
               "By depth, a stiff place pushes back harder; by force, it gives way less and shows a shallower dent, "
               "which is better for comparing places.");
  if (touch.by == device::PressBy::depth) {
    numberWidget(touch.depth_mm,
                 {"touch/depth", "depth", "%.1f mm", 0.0, kMaxDepthMm, 6.0,
                  "How deep the finger presses. Wheel while pressing: 0.5 mm per notch, with Shift 0.1."});
  } else {
    numberWidget(touch.force_n, {"touch/force", "normal force", "%.2f N", 0.0, kMaxForceN, 3.0,
                                 "How hard the finger presses: the force along the press, without the sideways pull. "
                                 "Wheel while pressing: 0.25 N per notch."});
  }
  flagWidget("touch/resisting", "resist while pressing", touch.resisting_cursor,
             "Pressing with both buttons slows down as the skin pushes back harder, so that you see resistance.");
}

void radiusWidget(scene::Scene& scene, std::size_t active, UiOutput& output) {
  double radius = fingerRadius(scene, active);
  if (!numberWidget(radius, {"touch/radius", "finger radius", "%.1f mm", 0.5, 30.0, 8.0,
                             "Radius of the finger in use; 8 mm is a fingertip."})) {
    return;
  }
  while (scene.fingers.size() <= active) {
    scene::Finger finger;
    finger.name = fmt::format("finger_{}", scene.fingers.size() + 1);
    finger.steps = {{}, {}};  // a scene file needs a finger's steps: none
    scene.fingers.push_back(finger);
  }
  scene.fingers[active].radius_mm = radius;
  output.changed |= kFingerChange;
}

/// The skin never holds a sliding finger better than a still one: each slider pushes the other along.
void gripWidgets(contact::FingerSettings& friction, UiOutput& output) {
  if (numberWidget(friction.mu_static, {"friction/static", "grip", "%.2f", 0.0, 2.0, 0.46,
                                        "Friction up to which the skin sticks to the finger (static coefficient)."})) {
    friction.mu_dynamic = std::min(friction.mu_dynamic, friction.mu_static);
    output.changed |= kFingerChange;
  }
  if (numberWidget(friction.mu_dynamic, {"friction/dynamic", "grip, sliding", "%.2f", 0.0, 2.0, 0.44,
                                         "Friction while the finger slips (dynamic coefficient)."})) {
    friction.mu_static = std::max(friction.mu_static, friction.mu_dynamic);
    output.changed |= kFingerChange;
  }
}

}  // namespace

void touchPanel(const TouchPanel& panel, UiOutput& output) {
  const SceneKeys keys{panel.scene, output};
  choiceWidget("touch/finger", "finger", panel.active_finger, kFingerChoices,
               "Which finger the mouse moves; the other stays where it is (keys 1 and 2).");
  pressWidgets(panel.touch);
  radiusWidget(panel.scene, panel.active_finger, output);
  ImGui::Separator();
  keyWidget(keys, {"friction", "skin", "skin"});
  gripWidgets(panel.scene.contact.finger, output);
  keyWidget(keys, {"friction", "stiffness_ratio", "sideways stiffness", 0.05, 3.0});
  ImGui::Separator();
  keyWidget(keys, {"contact", "source", "feels through"});
  keyWidget(keys, {"contact", "max_depth_mm", "deepest", 1.0, 100.0, "%.0f mm"});
  keyWidget(keys, {"contact", "force_shading", "smooth over triangles"});
}

}  // namespace palpate::viewer
