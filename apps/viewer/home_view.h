// Where the camera stands so that the whole body is seen in what panels and plots leave of the window. Pure.
#pragma once

#include "apps/viewer/session.h"
#include "palpate/scene/world.h"

namespace palpate::viewer {

view::Camera homeView(const scene::World& world, const Session& session, view::StandardView side,
                      const Vec2& size_points);

}  // namespace palpate::viewer
