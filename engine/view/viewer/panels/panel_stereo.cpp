// Two eyes: how their pictures are packed, and how far apart they are.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>

#include "palpate/base/language.h"
#include "view/viewer/panels/panels.h"
#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {

namespace {

const char* wordsFor(window::HeadTracker::State state) {
  using State = window::HeadTracker::State;
  if (state == State::tracking) return toTranslate("seen");
  if (state == State::standing_still) return toTranslate("lost: the picture is frozen");
  return state == State::gliding ? toTranslate("lost: back to the place below")
                                 : toTranslate("not tracked: the place below");
}

void placeWidgets(Vec3& place, const std::array<const char*, 3>& paths, const Vec3& fallback, const char* meaning) {
  static constexpr std::array<const char*, 3> kAxes = {toTranslate("right"), toTranslate("up"),
                                                       toTranslate("towards you")};
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    numberWidget(place[axis], {paths[i], kAxes[i], "%.0f mm", -1500.0, 1500.0, fallback[axis], meaning});
  }
}

/// For displays that share their place with the hand: the body behind a window of true size.
void headWidgets(HeadSettings& head, const SeenHead& seen) {
  ImGui::Separator();
  flagWidget("stereo/head", "head before a real screen", head.on,
             "The screen is a window onto a body of true size, seen from where the eyes are.");
  if (!head.on) return;
  numberWidget(head.screen_height_mm, {"stereo/screen", "screen height", "%.0f mm", kMinScreenMm, kMaxScreenMm, 300.0,
                                       "Height of the lit part of the screen."});
  valueLine("eyes", fmt::format("{:.0f}, {:.0f}, {:.0f} mm", seen.eyes_mm.x(), seen.eyes_mm.y(), seen.eyes_mm.z()));
  remark(wordsFor(seen.state));
  ImGui::TextUnformatted(tr("eyes when not tracked"));
  placeWidgets(head.expected_mm, {"stereo/head_x", "stereo/head_y", "stereo/head_z"}, {0.0, 0.0, 600.0},
               "The point between the eyes, from the middle of the screen.");
  head.expected_mm.z() = std::max(head.expected_mm.z(), kNearestHeadMm);
  ImGui::TextUnformatted(tr("the tracker is at"));
  placeWidgets(head.offset_mm, {"stereo/offset_x", "stereo/offset_y", "stereo/offset_z"}, Vec3::Zero(),
               "Its origin, from the middle of the screen; added to all its measurements.");
}

}  // namespace

void stereoPanel(const StereoPanel& panel) {
  view::StereoSettings& stereo = panel.stereo;
  choiceWidget("stereo/mode", "mode", stereo.mode, view::kStereoModeNames,
               "How the two pictures share the screen (key K). \"half\" squeezes each, as televisions expect.");
  numberWidget(stereo.eye_distance_mm,
               {"stereo/eyes", "eye distance", "%.1f mm", 0.0, 80.0, 63.0,
                "Distance between your eyes: 63 mm on average, mostly 50 to 75. At 0 both eyes see the same."});
  numberWidget(stereo.convergence_mm,
               {"stereo/convergence", "screen plane at", "%.0f mm", 0.0, 5000.0, 0.0,
                "From the eyes to the plane that appears in the screen; 0 is the place that the camera turns about."});
  flagWidget("stereo/swap", "swap the eyes", stereo.swap_eyes, "For when near looks far (Shift+K).");
  headWidgets(panel.head, panel.seen);
  if (!view::isStereo(stereo.mode)) return;
  const double aspect = 1.6;
  const view::Eyes eyes = view::placeEyes(panel.camera, stereo, aspect);
  const Vec3 half = 0.5 * Vec3(panel.world.width_mm, panel.world.height_mm, panel.world.depth_mm);
  const Eigen::AlignedBox3d box(panel.camera.centre - half, panel.camera.centre + half);
  const double worst = view::computeComfort(eyes, stereo.eye_distance_mm, box).worst();
  valueLine("squint", fmt::format("{:.2f} deg", worst));
  if (worst > view::kComfortableDeg)
    remark("More than 1 degree tires the eyes: move back, or reduce the eye distance.");
}

}  // namespace palpate::viewer
