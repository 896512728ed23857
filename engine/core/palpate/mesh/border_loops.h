// Borders as closed runs of edges: what would have to be filled to close a mesh.
//
// Read by `surfaceState` (how open is it) and `findHoles` (what may be filled).
#pragma once

#include <cstddef>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/mesh/topology.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::mesh {

/// A closed run of border edges that comes to no vertex twice.
struct BorderLoop {
  /// In the direction in which triangles that fill it run along them: vertex i to vertex i + 1, the last to the first.
  std::vector<Index> vertices;
  /// The one half-edge at each of these edges; it runs the other way.
  std::vector<Index> half_edges;
};

struct Borders {
  std::size_t edges = 0;  ///< edges of exactly one triangle
  std::vector<BorderLoop> loops;
  std::vector<Index> unclosed;  ///< half-edges whose run ends where it is not clear which one is next
};

/// Where several fans of triangles meet in a border vertex, a run leads across the gap to the next fan: cracks around a
/// patch that hangs on its corners are loops of their own. A run that returns to a vertex is cut there into two loops.
/// Indices must be within range.
Borders findBorders(const TriangleMesh& mesh, const EdgeUses& edges);

/// Half the length of the sum of cross products, mm^2: no surface with this border is smaller.
double leastArea(const TriangleMesh& mesh, const BorderLoop& loop);

/// Area of the fan of triangles from the loop's middle, mm^2: there is a surface with this border that is as small.
double fanArea(const TriangleMesh& mesh, const BorderLoop& loop);

double lengthOf(const TriangleMesh& mesh, const BorderLoop& loop);

}  // namespace palpate::mesh
