// Parts made next to each other with next to nothing between them: bones of one segmentation, boxes of one model.
//
// Where a wall of one part faces a wall of another across a gap that no finger can enter, neither is skin: a point
// drawn across would be held by the hidden wall of the second part, by as much as it is deep. Without them, and with
// their rims made one, the parts are one body.
#pragma once

#include <cstddef>
#include <vector>

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::mesh {

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

}  // namespace palpate::mesh
