// The maps of a scene: of its body as it is felt there, with its dysfunctions, instead of a bare skin.
#pragma once

#include "palpate/scene/world.h"
#include "report/map/map_sources.h"

namespace palpate::app {

/// The scene's body as it was built: mended and ordered, so its vertices are those of forces.csv's triangles.
MapSkin skinOfScene(const scene::World& world);

/// What a finger meets: the healthy body, then what is wrong with it.
SkinMap stiffnessOfScene(const MapSkin& skin, const scene::World& world);
/// Throws Error for a body without bones.
SkinMap depthOfScene(const MapSkin& skin, const scene::World& world);
/// `quantity` is half-major, aspect or direction.
SkinMap ellipsesOfScene(const MapSkin& skin, const scene::World& world, const std::string& quantity);
/// The boundaries of drags as the deformation has them. Throws Error for a scene whose drags have no contours.
SkinMap contoursOfScene(const MapSkin& skin, const scene::World& world);

}  // namespace palpate::app
