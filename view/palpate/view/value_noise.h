// Smooth noise that is the same on every machine.
//
// Based on: Perlin, "An image synthesizer", 1985 (noise as sums of smooth lattice values).
#pragma once

#include "palpate/base/vec.h"

namespace palpate::view {

/// Smooth noise in [-1, 1] between values at the corners of a unit lattice (value noise).
double noiseAt(const Vec3& p);

}  // namespace palpate::view
