// Where looking begins: the camera that sees the whole body in what panels and plots leave of the window, and what the
// scene file says about its pictures ([view]), taken over when the scene is opened. Pure.
#pragma once

#include "palpate/scene/world.h"
#include "palpate/view/camera.h"
#include "view/viewer/state/viewer_state.h"

namespace palpate::viewer {

view::Camera homeView(const scene::World& world, const Shown& shown, view::StandardView side, const Vec2& size_points);
/// The same of a part of it.
view::Camera viewOf(const Eigen::AlignedBox3d& box, const Shown& shown, view::StandardView side,
                    const Vec2& size_points);

/// The same camera with a place in the middle of the free part, which turns about it.
view::Camera centredInFreePart(const view::Camera& camera, const Vec3& place, const Shown& shown,
                               const Vec2& size_points);

/// The camera of a picture that shows just the free part: what a scene says about its camera. takeSceneLook goes back.
view::Camera cameraOfFreePart(const view::Camera& camera, const Shown& shown, const Vec2& size_points);

/// Camera, look, stereo and head, each as far as the scene says something about it; the rest stays the user's. True if
/// the camera was among it: it then looks at what panels and plots leave free, as homeView does.
bool takeSceneLook(const scene::World& world, ViewerState& viewer, const Vec2& size_points);

}  // namespace palpate::viewer
