// Orientation of triangles: made the same within a part, outwards for closed parts.
//
// A *patch* is a set of triangles connected across edges with exactly two triangles.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "palpate/mesh/topology.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::mesh {

struct Patches {
  std::vector<Index> of_triangle;
  Index count = 0;
  std::vector<bool> flipped;   ///< per triangle: winding disagrees with the majority of its patch
  std::size_t seam_edges = 0;  ///< edges that stay inconsistent under any flips: the patch is one-sided
};

/// Breadth first from the lowest triangle of each patch; the mesh is not changed.
Patches findPatches(const TriangleMesh& mesh, const EdgeUses& edges);

/// Flips every triangle that disagrees with its patch; returns how many.
std::size_t makeWindingConsistent(TriangleMesh& mesh, const Patches& patches);

/// Turns closed patches outside out that enclose a negative volume, and closed parts of patches that meet in edges of
/// more than two triangles; returns how many. Those that lie inside another stay: they are the wall of a hollow. Closed
/// parts stay closed. Winding must be consistent; `edges` and `patches` must be those of the mesh as it is wound.
std::size_t turnOutwards(TriangleMesh& mesh, const EdgeUses& edges, const Patches& patches);

/// Winding number of the triangles around the point: near 0 outside, near +-1 inside. The exact sum of solid angles.
double windingNumber(const TriangleMesh& mesh, std::span<const Index> triangles, const Vec3& point);

/// Volume under the triangles, mm^3: enclosed when they are closed, positive when they face outwards.
double signedVolume(const TriangleMesh& mesh);

}  // namespace palpate::mesh
