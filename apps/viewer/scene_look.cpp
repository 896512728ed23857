#include "apps/viewer/scene_look.h"

#include <algorithm>
#include <array>
#include <span>

#include "palpate/scene/scene_edit.h"
#include "palpate/view/scene_view.h"

namespace palpate::viewer {

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
