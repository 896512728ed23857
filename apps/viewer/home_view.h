// Where the camera stands so that the whole body is seen in what panels and plots leave of the window. Pure.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "apps/viewer/session.h"
#include "palpate/scene/world.h"
#include "palpate/view/camera.h"

namespace palpate::viewer {

view::Camera homeView(const scene::World& world, const Session& session, view::StandardView side,
                      const Vec2& size_points);

// What a scene file says about its pictures ([view]), taken over when the scene is opened.

/// Camera, look, stereo and head, each as far as the scene says something about it; the rest stays the user's. True if
/// the camera was among it.
bool takeSceneLook(const scene::World& world, Session& session, double aspect);

// A camera as a line of text, so that a view can be mailed, kept in notes and pasted back.

/// "palpate-view x y z yaw_deg pitch_deg distance_mm height_deg"
std::string viewAsText(const view::Camera& camera);
std::optional<view::Camera> viewFromText(std::string_view text);

}  // namespace palpate::viewer
