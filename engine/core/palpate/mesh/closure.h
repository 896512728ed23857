// Measures of closedness that can be compared before and after a repair.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "palpate/mesh/holes.h"
#include "palpate/mesh/topology.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::mesh {

enum class Closure : std::uint8_t {
  closed,         ///< every edge is used as often one way as the other (and there is a triangle)
  nearly_closed,  ///< except for holes that are small for the part they are in (holes.h)
  open
};

/// "closed", "nearly closed", "open".
std::string_view wordsFor(Closure closure);

struct SurfaceState {
  Closure closure = Closure::open;
  std::size_t triangles = 0;
  std::size_t vertices = 0;
  std::size_t border_edges = 0;        ///< edges of one triangle
  std::size_t border_loops = 0;        ///< connected runs of border edges
  std::size_t non_manifold_edges = 0;  ///< edges of more than two triangles
  /// Length of all sides of triangles that nothing cancels, mm: 0 when closed, and no split of an edge changes it.
  double open_length_mm = 0.0;
};

/// Indices must be within range, coordinates finite.
SurfaceState surfaceState(const TriangleMesh& mesh, const EdgeUses& edges, const Holes& holes);

}  // namespace palpate::mesh
