// How much of the sky each place of the skin at rest sees: in folds, under arms and along the spine less arrives. Once
// at load; skin_tint.h darkens the colour of the skin by it.
#pragma once

#include <vector>

#include "palpate/deform/skin.h"

namespace palpate::view {

/// One a vertex: 1 sees all of its sky, 0 nothing. A few hundredths of a second, whatever the number of triangles.
std::vector<float> skyLeft(const deform::Skin& skin);

}  // namespace palpate::view
