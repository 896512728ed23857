// Whether two worlds differ only in what lies on the body: stiffness, ellipses, force law, deformation.
#pragma once

#include "palpate/scene/world.h"

namespace palpate::view {

/// The same skin, bones and texture, vertex by vertex, as scene::rebuilt leaves them. A few ms for a million
/// triangles.
bool haveSameBody(const scene::World& a, const scene::World& b);

}  // namespace palpate::view
