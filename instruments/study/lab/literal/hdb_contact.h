// The dissertation's haptic process, leaf by leaf: find the leaves of a BSP tree that the detecting box meets, then ask
// every triangle in them, one after the other, in double, on the array of structures of literal/mesh.h.
//
// The traversal tests tight boxes (E4, E5): as printed it would miss triangles and its answers would be wrong.
// Based on: Ji, dissertation 2008, sections 3.1 to 3.3; Sunday (2003), which it cites, for segment and triangle.
#pragma once

#include <vector>

#include "lab/literal/mesh.h"
#include "palpate/hdb/haptic_box.h"

namespace palpate::bench::literal {

struct HdbContact {
  Mesh mesh;
  hdb::Partition tree;
  double edge_mm = 0.0;  ///< edge of the detecting box: a quarter of the model's longest
  hdb::LeafHits leaves;
};

/// BSP tree, case C, at most 1024 triangles in a leaf: the dissertation's choice.
HdbContact buildHdbContact(const mesh::TriangleMesh& mesh);

/// Distance of the nearest point of the triangles in the leaves around `centre`; infinite: none within `reach`.
double nearestInLeaves(HdbContact& contact, const Vec3& centre, const Vec3& point, double reach);

/// Whether a segment crosses a triangle in the leaves around `centre`, from either side.
bool crossesInLeaves(HdbContact& contact, const Vec3& centre, const Vec3& from, const Vec3& to);

/// The triangles whose boxes meet `box`, by asking every triangle of every leaf that it meets.
void trianglesInLeaves(HdbContact& contact, const Box3& box, std::vector<Index>& found);

}  // namespace palpate::bench::literal
