// Triangles without height: found for `validate`, removed by `repair` without leaving a slit.
//
// A sliver has no usable normal: a folded one points backwards although its winding is right. Dropping it would leave a
// hairline border on which the finger's walk stops, so it is collapsed or its neighbours are sewn together instead.
#pragma once

#include <cstddef>

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::mesh {

/// Heights up to this share of the diagonal of the used vertices' box count as zero: about 1e6 times the rounding of a
/// double, and a thousand times finer than the smallest feature of a mesh stored in floats.
inline constexpr double kSliverShare = 1e-9;

/// kSliverShare of the diagonal in mm; triangles must name existing, finite vertices.
double sliverHeight(const TriangleMesh& mesh);

/// Two corners are one vertex, or the triangle's height over its longest edge is at most `height` mm.
bool isSliver(const TriangleMesh& mesh, const Triangle& triangle, double height);

struct SliversRemoved {
  std::size_t collapsed = 0;  ///< triangles with a short edge, whose ends became one vertex
  std::size_t sewn = 0;       ///< flat ones: the neighbour across the long edge was split at the third corner
  std::size_t dropped = 0;    ///< neither worked in time (a knot of many slivers)
};

/// Takes out every sliver. No vertex moves, some are merged; positions stay as they are (unused ones too).
SliversRemoved removeSlivers(TriangleMesh& mesh);

/// Removes triangles from `first` on that are lower than `height` mm, the same way, and the parts that they cut off
/// their neighbours. Those that cannot be removed stay.
void sewCracks(TriangleMesh& mesh, Index first, double height);

}  // namespace palpate::mesh
