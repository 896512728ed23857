// Differences between places of the skin, one per vertex: mottling, redness, thin skin over bone, shade in folds.
//
// Computed once at load in rest coordinates, so that it moves with the skin. The shader multiplies it with the colour
// of the whole skin; finer detail is the shader's own (skin_shader.h).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "palpate/deform/skin.h"
#include "palpate/scene/world.h"

namespace palpate::view {

/// Red, green and blue: a factor on the colour of the skin, kTintUnit is 1. Fourth: curvature, 255 = a fingertip's.
using TintBytes = std::array<std::uint8_t, 4>;

inline constexpr double kTintUnit = 128.0;

/// One per vertex of the skin.
std::vector<TintBytes> skinTints(const scene::World& world);

/// The share of the sky that each place of the skin at rest sees: less light reaches folds, armpits and the spine. Once
/// at load; skinTints darkens the colour of the skin by it.
/// One per vertex: 1 sees all of its sky, 0 nothing. A few hundredths of a second, whatever the number of triangles.
std::vector<float> skyLeft(const deform::Skin& skin);

}  // namespace palpate::view
