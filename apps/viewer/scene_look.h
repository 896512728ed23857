// What a scene file says about its pictures ([view]), taken over when the scene is opened.
#pragma once

#include "apps/viewer/session.h"
#include "palpate/scene/world.h"

namespace palpate::viewer {

/// Camera, look, stereo and head, each as far as the scene says something about it; the rest stays the user's. True if
/// the camera was among it.
bool takeSceneLook(const scene::World& world, Session& session, double aspect);

}  // namespace palpate::viewer
