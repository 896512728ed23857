// A picture of skin that the program paints itself: pigment and blood of a back, with moles, freckles and other details
// of a photograph.
//
// The paint is relative to the tone of the whole skin, so that any tone may be under it. Colours of the folds and over
// the bones are not in it: they are the body's own (layers/skin_tint.h).
#pragma once

#include "palpate/base/vec.h"
#include "palpate/scene/skin_texture.h"
#include "palpate/view/image.h"

namespace palpate::view {

/// The most that a place may be brighter than the tone: the picture's white.
inline constexpr float kMadeSkinWhite = 1.35f;

/// Factors on the tone, over kMadeSkinWhite, as sRGB. The same seed and body give the same picture. Its left and right
/// edges fit each other. About a second for a whole trunk (2 pixels per millimetre).
Image paintedSkin(const scene::MadeSkin& made);

/// Smooth noise in [-1, 1] between values at the corners of a unit lattice (value noise), the same on every machine.
///
/// Based on: Perlin, "An image synthesizer", 1985 (noise as sums of smooth lattice values).
double noiseAt(const Vec3& p);

}  // namespace palpate::view
