// Edges of a mesh that pierce its own triangles.
//
// On a surface without them a finger's walk stays on the one sheet it touches; with them it can slide inside another.
#pragma once

#include <cstddef>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::mesh {

/// An edge that crosses a triangle which shares no vertex with it.
struct Crossing {
  Index low;  ///< the edge's vertices
  Index high;
  Index triangle;
  bool touches;  ///< it meets the triangle's border, an edge or a corner, and not its inside
};

struct Intersections {
  std::size_t piercing_edges = 0;        ///< pass through a triangle
  std::size_t touching_edges = 0;        ///< those of them that meet edges and corners only, the inside of no triangle
  std::vector<Index> pierced_triangles;  ///< whose inside is met; ascending, each once
  std::vector<Index> touched_triangles;  ///< met by edges that only touch; the same
  std::vector<Crossing> crossings;       ///< sorted by edge, then by triangle
  bool complete = true;  ///< false: the search was stopped because of too many overlaps; the results so far are real
};

/// Edges whose ends are clearly on both sides of a triangle that they cross. Ending on it and being in its plane do not
/// count. Indices must be within range and coordinates finite. About 1 us a triangle, less in a mesh in spatial order
/// (reorder.h); memory 60 bytes a triangle.
Intersections findIntersections(const TriangleMesh& mesh, const Progress& progress = {});

/// An unfinished search means dense overlaps: it counts as intersecting, which is the safe side.
inline bool isSelfIntersecting(const Intersections& found) { return found.piercing_edges > 0 || !found.complete; }

}  // namespace palpate::mesh
