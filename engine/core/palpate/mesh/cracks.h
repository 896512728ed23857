// Cracks: border loops without width, where one side has vertices that the other lacks (T-junctions).
//
// `findHoles` requests a plan before any filling; nothing is filled where sides can be joined.
#pragma once

#include <optional>
#include <vector>

#include "palpate/mesh/border_loops.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::mesh {

/// Vertices to put on one side of a triangle, in the order in which the half-edge comes to them.
struct SideSplit {
  Index half_edge;
  std::vector<Index> vertices;
};

/// Joins the sides of the loop: every vertex that lies within `width` mm of an edge across splits it. Empty when that
/// does not match each edge with its opposite. Time grows with the square of the loop.
std::optional<std::vector<SideSplit>> planCrack(const TriangleMesh& mesh, const BorderLoop& loop, double width);

/// Executes it; no half-edge may occur twice. Triangles that are split keep one piece in their place, the others come
/// at the end.
void splitSides(TriangleMesh& mesh, std::vector<SideSplit> splits);

}  // namespace palpate::mesh
