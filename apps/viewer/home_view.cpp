#include "apps/viewer/home_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "apps/viewer/panels/gui_layout.h"
#include "palpate/scene/scene_edit.h"
#include "palpate/view/scene_view.h"

namespace palpate::viewer {

view::Camera homeView(const scene::World& world, const Shown& shown, view::StandardView side, const Vec2& size_points) {
  const auto width = static_cast<float>(size_points.x());
  const auto height = static_cast<float>(size_points.y());
  const FreeArea free = freeArea(shown, width, height);
  const double free_width = std::max(50.0f, free.right - free.left);
  const double free_height = std::max(50.0f, free.below - free.top);
  view::Camera camera = view::fitted(mesh::boundingBox(world.skin), free_width / free_height, side);
  // Fitted for the free part alone; the window shows more, so the same size there needs a camera further away.
  camera.distance_mm *= height / free_height;
  const double mm_per_pixel = 2.0 * camera.distance_mm * std::tan(0.5 * camera.height_rad) / height;
  const double right = 0.5 * (free.left + free.right - width);
  const double below = 0.5 * (free.top + free.below - height);
  camera.centre += mm_per_pixel * (below * camera.up() - right * camera.right());
  return camera;
}

namespace {

constexpr std::array<std::string_view, 5> kCameraKeys = {"side", "yaw_deg", "pitch_deg", "zoom", "look_at_mm"};
constexpr std::array<std::string_view, 6> kLookKeys = {"shading", "colours", "show",
                                                       "opacity", "finger",  "white_background"};
constexpr std::array<std::string_view, 4> kStereoKeys = {"stereo", "eye_distance_mm", "convergence_mm", "swap_eyes"};

/// Some key has another value than it would have if it were left out.
bool says(const scene::Scene& scene, std::span<const std::string_view> keys) {
  return std::any_of(keys.begin(), keys.end(), [&](std::string_view key) {
    const auto row = scene::keyOf(scene, "view", key);
    return row && row->fallback != scene::defaultOf("view", key);
  });
}

}  // namespace

bool takeSceneLook(const scene::World& world, Session& session, double aspect) {
  const view::PictureSettings said = view::pictureSettings(world, aspect);
  ViewState& state = session.state;
  if (says(world.scene, kLookKeys)) state.look = said.look;
  if (says(world.scene, kStereoKeys)) state.stereo = said.stereo;
  state.stereo.head.reset();  // HeadSettings speaks for it
  if (said.stereo.head) {
    state.head.on = true;
    state.head.expected_mm = said.stereo.head->eyes_mm;
    state.head.screen_height_mm = said.stereo.head->screen_height_mm;
  }
  if (!says(world.scene, kCameraKeys)) return false;
  session.camera = said.camera;
  return true;
}

}  // namespace palpate::viewer
