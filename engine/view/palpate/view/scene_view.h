// Translates a scene file's view settings for the folders that draw.
#pragma once

#include <string_view>

#include "palpate/scene/world.h"
#include "palpate/view/painter.h"

namespace palpate::view {

/// Camera, look, stereo and labels of this scene, for a picture of `aspect` (width over height). The colours of a map
/// cover the world's values; strain the scene's range.
PictureSettings pictureSettings(const scene::World& world, double aspect);
/// The same with other view settings than the scene's own.
PictureSettings pictureSettings(const scene::World& world, const scene::ViewSettings& view, double aspect);

/// Selects a number of the body's file for Colouring::scalar, over all of its values; an empty name means the first.
/// Leaves the look unchanged where the file has none of this name.
void showScalar(const scene::World& world, std::string_view name, Look& look);

}  // namespace palpate::view
