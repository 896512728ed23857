// The initial view: the camera that sees the whole body in the part of the window that panels and plots leave free, and
// the scene file's picture settings ([view]), adopted when the scene is opened. Pure.
#pragma once

#include "palpate/scene/world.h"
#include "palpate/view/camera.h"
#include "view/viewer/state/viewer_state.h"

namespace palpate::viewer {

view::Camera homeView(const scene::World& world, const Shown& shown, view::StandardView side, const Vec2& size_points);
/// The same for a part of it.
view::Camera fitToFreePart(const Eigen::AlignedBox3d& box, const Shown& shown, view::StandardView side,
                           const Vec2& size_points);

/// The same camera with a place in the middle of the free part, about which it turns.
view::Camera centredInFreePart(const view::Camera& camera, const Vec3& place, const Shown& shown,
                               const Vec2& size_points);

/// The camera of a picture of just the free part, as scenes store it. applySceneLook is the inverse.
view::Camera cameraOfFreePart(const view::Camera& camera, const Shown& shown, const Vec2& size_points);

/// Adopts camera, look, stereo and head as far as the scene sets them; the rest stays the user's. True if the camera
/// was among them: it then covers the part that panels and plots leave free, as homeView does.
bool applySceneLook(const scene::World& world, BodyView& seen, const Vec2& size_points);

}  // namespace palpate::viewer
