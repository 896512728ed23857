// Where on a world's skin the words of an examiner point: "T6", "left PSIS", "T6 right 30 mm".
#pragma once

#include <string_view>

#include "palpate/base/skin_place.h"
#include "palpate/scene/world.h"

namespace palpate::engine {

/// The place of the skin at rest, with the normal and the number of its triangle of the mesh. Distances in the words go
/// along x and y, and then back to the skin along z, as for a finger's `at`. Throws Error naming what is near in
/// spelling, and for a body without named places.
SkinPlace skinPlace(const scene::World& world, std::string_view words);

/// The same from a point: the nearest place of the skin.
SkinPlace nearestOnSkin(const scene::World& world, const Vec3& point);

}  // namespace palpate::engine
