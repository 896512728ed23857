// Where on a world's skin words point, under the name that drawing knows it by: engine/skin_place.h, which needs no
// OpenGL.
#pragma once

#include "palpate/engine/skin_place.h"

namespace palpate::view {

using engine::nearestOnSkin;
using engine::skinPlace;

}  // namespace palpate::view
