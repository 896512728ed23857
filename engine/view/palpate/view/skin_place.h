// Named places on a world's skin, under drawing's name: engine/skin_place.h, which needs no OpenGL.
#pragma once

#include "palpate/engine/skin_place.h"

namespace palpate::view {

using engine::nearestOnSkin;
using engine::skinPlace;

}  // namespace palpate::view
