// What docs/howto/pictures.md takes for given.
#pragma once

#include "palpate/deform/surface.h"
#include "palpate/view/picture.h"

namespace palpate::snippet {
extern const std::shared_ptr<const scene::World> world;
extern const deform::DeformedSurface surface;
extern const std::vector<view::FingerMark> fingers;
extern const double head_x, head_y, head_z, time_s;
}  // namespace palpate::snippet
