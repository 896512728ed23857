// Strain of the deformed skin in two ways, and its colour. Last step of an apply, where strain is requested.
//
// The mean over the edges of a vertex (4.20) hides pure shear (E24). Principal strain does not: the edges of the
// vertex's fan (spokes and rim) are taken as the gauges of a strain rosette; from their relative changes of length and
// their directions in the tangent plane follows the Green strain tensor of the fan, by least squares. It is exact for a
// uniform deformation of a flat fan, exactly 0 for any rigid motion, and needs nothing but lengths. Its eigenvalues E
// give the principal strains sqrt(1 + 2 E) - 1, relative changes of length like (4.19). Based on: Ji, dissertation
// 2008, section 4.7, with E24; the rosette is the textbook one of strain gauges.
#pragma once

#include <array>
#include <span>

#include "palpate/deform/normals.h"

namespace palpate::deform {

/// (4.19): relative change of length of an edge whose ends move apart by `stretch_mm` (difference of their
/// displacements); > 0 is tension. 0 for an edge without length.
double edgeStrain(const Vec3& rest_edge_mm, const Vec3& stretch_mm) noexcept;

/// (4.20): mean strain of the edges of a vertex; 0 for a vertex without edges. Exactly 0 where nothing moved.
float strainOfVertex(const Skin& skin, const PositionStreams& displacements, Index vertex) noexcept;

/// Both principal strains; tension is positive.
struct PrincipalStrains {
  double largest = 0.0;
  double smallest = 0.0;
  /// The one of larger magnitude, with its sign; tension where both are equally large.
  double dominant() const { return -smallest > largest * (1.0 + 1e-9) ? smallest : largest; }
};

/// Zero for a vertex without triangles or whose edges all lie on one line. Exactly zero where nothing moved.
PrincipalStrains principalStrains(const Skin& skin, const PositionStreams& displacements, Index vertex) noexcept;

/// Red, green, blue, 0..255.
using Rgb = std::array<std::uint8_t, 3>;

/// Red for tension, blue for compression, a light grey for none; linear up to +-range (E24: default 20 %), full beyond.
/// NaN is grey.
Rgb strainColour(float strain, float range = 0.2f) noexcept;

/// One colour a vertex. `colours` must have as many entries.
void colourByStrain(std::span<const float> strain, float range, std::span<Rgb> colours) noexcept;

}  // namespace palpate::deform
