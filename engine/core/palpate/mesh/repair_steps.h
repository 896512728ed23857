// Two steps of repair (repair.h): hairline gaps between parts are closed first, fans are made last.
#pragma once

#include <cstddef>
#include <vector>

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::mesh {

// Parts made next to each other with next to nothing between them: bones of one segmentation, boxes of one model.
//
// Where a wall of one part faces a wall of another across a gap that no finger can enter, neither is skin: a point
// drawn across would be held by the hidden wall of the second part, by as much as it is deep. Without them, and with
// their rims made one, the parts are one body.

/// Gaps up to this share of the diagonal are closed: 0.02 mm on a hand.
inline constexpr double kHairlineShare = 1e-4;

struct HairlineGaps {
  /// The replacement of each vertex, or itself: those of the walls are merged across the gap.
  std::vector<Index> same_as;
  std::vector<bool> is_wall;  ///< per triangle: to be dropped
  std::size_t walls = 0;
};

/// Walls face each other, vertex by vertex within `distance_mm` and between the same rims (however they are cut into
/// triangles), and belong to two parts (findComponents). Without them what was closed still is. Indices must be within
/// range.
HairlineGaps findHairlineGaps(const TriangleMesh& mesh, double distance_mm);

// Last step of repair: every edge gets 0 or 1 neighbour, every vertex one fan.
//
// A finger walks over edges and around vertices; it never meets an edge with a choice of neighbours. Where several
// sheets touch in an edge, each face is joined with the next one on its front side: the one that bounds the same empty
// sector, which is where the finger is. Then vertices are copied so that indices agree with the joints.

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
