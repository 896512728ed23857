#include "view/viewer/state/home_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "palpate/scene/scene_edit.h"
#include "palpate/view/scene_view.h"
#include "view/viewer/state/free_area.h"

namespace palpate::viewer {

namespace {

/// The part of the window that shows the picture alone, points.
struct FreePart {
  Vec2 size;
  Vec2 aside;  ///< offset of its middle from the window's, to the right and down
  double window_height;
};

FreePart freePart(const Shown& shown, const Vec2& size_points) {
  const auto width = static_cast<float>(size_points.x());
  const auto height = static_cast<float>(size_points.y());
  const FreeArea free = freeArea(shown, width, height);
  return {Vec2(std::max(50.0f, free.right - free.left), std::max(50.0f, free.below - free.top)),
          0.5 * Vec2(free.left + free.right - width, free.top + free.below - height), height};
}

/// Moves the window's middle to that of the free part.
view::Camera movedAside(view::Camera camera, const FreePart& part) {
  const double mm_per_pixel = 2.0 * camera.distance_mm * std::tan(0.5 * camera.height_rad) / part.window_height;
  camera.centre += mm_per_pixel * (part.aside.y() * camera.up() - part.aside.x() * camera.right());
  return camera;
}

/// A camera made for the free part alone; the window shows more, so the same size there needs a camera further away.
view::Camera intoPart(view::Camera camera, const FreePart& part) {
  camera.distance_mm *= part.window_height / part.size.y();
  return movedAside(camera, part);
}

view::Camera outOfPart(view::Camera camera, const FreePart& part) {
  const double mm_per_pixel = 2.0 * camera.distance_mm * std::tan(0.5 * camera.height_rad) / part.window_height;
  camera.centre -= mm_per_pixel * (part.aside.y() * camera.up() - part.aside.x() * camera.right());
  camera.distance_mm *= part.size.y() / part.window_height;
  return camera;
}

}  // namespace

view::Camera cameraOfFreePart(const view::Camera& camera, const Shown& shown, const Vec2& size_points) {
  return outOfPart(camera, freePart(shown, size_points));
}

view::Camera centredInFreePart(const view::Camera& camera, const Vec3& place, const Shown& shown,
                               const Vec2& size_points) {
  return movedAside(view::centredOn(camera, place), freePart(shown, size_points));
}

view::Camera fitToFreePart(const Eigen::AlignedBox3d& box, const Shown& shown, view::StandardView side,
                           const Vec2& size_points) {
  const FreePart part = freePart(shown, size_points);
  return intoPart(view::fitted(box, part.size.x() / part.size.y(), side), part);
}

view::Camera homeView(const scene::World& world, const Shown& shown, view::StandardView side, const Vec2& size_points) {
  return fitToFreePart(mesh::boundingBox(world.body->skin), shown, side, size_points);
}

namespace {

constexpr std::array<std::string_view, 6> kCameraKeys = {"side", "yaw_deg",    "pitch_deg",
                                                         "zoom", "look_at_mm", "distance_mm"};
constexpr std::array<std::string_view, 12> kLookKeys = {"lens",
                                                        "shading",
                                                        "colours",
                                                        "show",
                                                        "opacity",
                                                        "finger",
                                                        "white_background",
                                                        "scalar",
                                                        "scalar_map",
                                                        "scalar_range",
                                                        "stiffness_range_n_per_mm",
                                                        "ellipse_range_mm"};
constexpr std::array<std::string_view, 4> kStereoKeys = {"stereo", "eye_distance_mm", "convergence_mm", "swap_eyes"};

/// Whether some key differs from its default.
bool says(const scene::Scene& scene, std::span<const std::string_view> keys) {
  return std::any_of(keys.begin(), keys.end(), [&](std::string_view key) {
    const auto row = scene::keyOf(scene, "view", key);
    return row && row->fallback != scene::defaultOf("view", key);
  });
}

}  // namespace

bool applySceneLook(const scene::World& world, BodyView& seen, const Vec2& size_points) {
  ViewState& state = seen.state;
  const FreePart part = freePart(state.shown, size_points);
  const view::PictureSettings said = view::pictureSettings(world, part.size.x() / part.size.y());
  if (says(world.scene, kLookKeys)) state.look = said.look;
  if (says(world.scene, kStereoKeys)) state.stereo = said.stereo;
  state.stereo.head.reset();  // HeadSettings has it
  if (said.stereo.head) {
    state.head.on = true;
    state.head.expected_mm = said.stereo.head->eyes_mm;
    state.head.screen_height_mm = said.stereo.head->screen_height_mm;
  }
  if (!says(world.scene, kCameraKeys)) return false;
  // Before a screen of true size the camera gives that screen's place.
  seen.camera = said.stereo.head ? said.camera : intoPart(said.camera, part);
  return true;
}

}  // namespace palpate::viewer
