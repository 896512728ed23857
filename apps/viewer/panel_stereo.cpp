// Two eyes: how their pictures are packed, and how far apart they are.
#include <fmt/format.h>
#include <imgui.h>

#include "apps/viewer/panels.h"
#include "apps/viewer/widgets.h"

namespace palpate::viewer {

void stereoPanel(Session& session) {
  view::StereoSettings& stereo = session.state.stereo;
  auto mode = static_cast<std::size_t>(stereo.mode);
  if (choiceWidget("stereo/mode", "mode", mode, view::kStereoModeNames,
                   "How the two pictures share the screen (key K). \"half\" squeezes each as televisions expect it.")) {
    stereo.mode = static_cast<view::StereoMode>(mode);
  }
  numberWidget(stereo.eye_distance_mm,
               {"stereo/eyes", "eye distance", "%.1f mm", 0.0, 80.0, 63.0,
                "Between your eyes: 63 mm on average, mostly 50 to 75. 0 shows both eyes the same."});
  numberWidget(stereo.convergence_mm,
               {"stereo/convergence", "screen plane at", "%.0f mm", 0.0, 5000.0, 0.0,
                "From the eyes to the plane that appears in the screen; 0 is the place that the camera turns about."});
  flagWidget("stereo/swap", "swap the eyes", stereo.swap_eyes, "When near looks far (Shift+K).");
  const double aspect = 1.6;
  const view::Eyes eyes = view::eyesOf(session.camera, stereo, aspect);
  const Eigen::AlignedBox3d box(
      session.camera.centre - 0.5 * Vec3(session.world.width_mm, session.world.height_mm, session.world.depth_mm),
      session.camera.centre + 0.5 * Vec3(session.world.width_mm, session.world.height_mm, session.world.depth_mm));
  if (!view::isStereo(stereo.mode)) return;
  const double worst = view::comfortOf(eyes, stereo.eye_distance_mm, box).worst();
  valueLine("squint", fmt::format("{:.2f} deg", worst));
  if (worst > view::kComfortableDeg)
    remark("More than 1 degree tires the eyes: come less near, or set the eyes closer.");
}

}  // namespace palpate::viewer
