// Last step of repair: every edge gets 0 or 1 neighbour, every vertex one fan.
//
// A finger walks over edges and around vertices; it never meets an edge with a choice of neighbours. Where several
// sheets touch in an edge, each face is joined with the next one on its front side: the one that bounds the same empty
// sector, which is where the finger is. Then vertices are copied so that indices agree with the joints.
#pragma once

#include <cstddef>
#include <vector>

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::mesh {

struct FansMade {
  std::size_t non_manifold_edges = 0;  ///< more than two triangles: resolved by angle
  std::size_t seam_edges = 0;          ///< two triangles of the same direction: cut
  std::size_t copied_vertices = 0;     ///< fans that got a vertex of their own
  std::size_t split_edges = 0;         ///< got a vertex in the middle, because copies alone left edges ambiguous
};

/// `source_vertex` grows with the mesh: a copied vertex has the source of its original, a middle one that of an end.
/// No slivers, no doubled triangles, indices within range.
FansMade makeFans(TriangleMesh& mesh, std::vector<Index>& source_vertex);

}  // namespace palpate::mesh
