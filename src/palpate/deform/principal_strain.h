// The principal strain of the skin around a vertex: what a mean over edges hides (E24).
//
// The edges of the vertex's fan (spokes and rim) are taken as the gauges of a strain rosette: from their relative
// changes of length and their directions in the tangent plane follows the Green strain tensor of the fan, by least
// squares. It is exact for a uniform deformation of a flat fan, exactly 0 for any rigid motion, and needs nothing but
// lengths. Its eigenvalues E give the principal strains sqrt(1 + 2 E) - 1, relative changes of length like (4.19).
// Based on: Ji, dissertation 2008, section 4.7, with E24; the rosette is the textbook one of strain gauges.
#pragma once

#include "palpate/deform/normals.h"

namespace palpate::deform {

/// Both principal strains; tension is positive.
struct PrincipalStrains {
  double largest = 0.0;
  double smallest = 0.0;
  /// The one of larger magnitude, with its sign; tension where both are equally large.
  double dominant() const { return -smallest > largest * (1.0 + 1e-9) ? smallest : largest; }
};

/// Zero for a vertex without triangles or whose edges all lie on one line. Exactly zero where nothing moved.
PrincipalStrains principalStrains(const Skin& skin, const PositionStreams& displacements, Index vertex) noexcept;

}  // namespace palpate::deform
