// From what a scene file says about its pictures to the settings of the rooms that draw.
#pragma once

#include <string_view>

#include "palpate/scene/world.h"
#include "palpate/view/painter.h"

namespace palpate::view {

/// Camera, look, stereo and labels of this scene, for a picture of `aspect` (width over height). The colours of a map
/// reach over the values that the world holds; strain over the scene's range.
PictureSettings pictureSettings(const scene::World& world, double aspect);
/// The same with other view settings than the scene's own.
PictureSettings pictureSettings(const scene::World& world, const scene::ViewSettings& view, double aspect);

/// Makes a number of the body's file the one that Colouring::scalar shows, over all of its values; an empty name means
/// the first. Leaves the look as it is where the file brings none of this name.
void showScalar(const scene::World& world, std::string_view name, Look& look);

}  // namespace palpate::view
