// Strain of the deformed skin, and its colour.
//
// Based on: Ji, dissertation 2008, section 4.7. The mean over the edges of a vertex hides pure shear (E24).
#pragma once

#include <array>
#include <span>

#include "palpate/deform/surface.h"

namespace palpate::deform {

/// (4.19): relative change of length of an edge whose ends move apart by `stretch_mm` (difference of their
/// displacements); > 0 is tension. 0 for an edge without length.
double edgeStrain(const Vec3& rest_edge_mm, const Vec3& stretch_mm) noexcept;

/// (4.20): mean strain of the edges of a vertex; 0 for a vertex without edges. Exactly 0 where nothing moved.
float strainOfVertex(const Skin& skin, const PositionStreams& displacements, Index vertex) noexcept;

/// Red, green, blue, 0..255.
using Rgb = std::array<std::uint8_t, 3>;

/// Red for tension, blue for compression, a light grey for none; linear up to +-range (E24: default 20 %), full beyond.
/// NaN is grey.
Rgb strainColour(float strain, float range = 0.2f) noexcept;

/// One colour a vertex. `colours` must have as many entries.
void colourByStrain(std::span<const float> strain, float range, std::span<Rgb> colours) noexcept;

}  // namespace palpate::deform
