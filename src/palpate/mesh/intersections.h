// Edges of a mesh that pierce its own triangles.
//
// On a surface without them a finger's walk stays on the one sheet it touches; with them it can slide inside another.
#pragma once

#include <cstddef>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::mesh {

struct Intersections {
  std::size_t piercing_edges = 0;
  std::vector<Index> pierced_triangles;  ///< ascending, each once
  bool complete = true;  ///< false: so much overlaps that the search was given up; what was found until then is real
};

/// Edges that cross a triangle which shares no vertex with them. Touching and lying in one plane do not count. Indices
/// must be within range and coordinates finite. About 1 us a triangle; memory 60 bytes a triangle.
Intersections findIntersections(const TriangleMesh& mesh, const Progress& progress = {});

}  // namespace palpate::mesh
