// A closed tube with an elliptic section that follows a line: ribs, costal cartilages, clavicles.
//
// No grid and no field: rings of corners along the line, joined by triangles, closed by rounding rings and a vertex at
// each end. Fast, and as smooth as the line.
#pragma once

#include <vector>

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::body {

/// One place on the line with the axes of its section: `along`, `outward`, `upward` are unit and right-handed.
struct Station {
  Vec3 centre, along, outward, upward;
  double half_height, half_thickness;  ///< along `upward` and along `outward`
};

/// Closure of an end.
struct SweptEnd {
  double rounding_mm =
      0.0;  ///< 0: round, a quarter circle of the half thickness; else flat with an edge of this radius
};

/// The tube through the stations in order, outward, closed; `corners` points per ring.
mesh::TriangleMesh sweepEllipse(const std::vector<Station>& stations, Index corners, SweptEnd first = {},
                                SweptEnd last = {});

/// Even number of corners whose edges are about `edge_mm` long on a section of this height and thickness; at least 8.
Index cornersOf(double height, double thickness, double edge_mm);

}  // namespace palpate::body
