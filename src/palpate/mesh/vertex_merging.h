// Renumbering of vertices: merging some into others, leaving out those that nothing uses.
#pragma once

#include <vector>

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::mesh {

/// Puts `same_as[v]` in the place of v in every triangle, then removes unused vertices. For each new vertex its old
/// index is returned. Wrong indices (out of range) are left as they are.
std::vector<Index> mergeVertices(TriangleMesh& mesh, const std::vector<Index>& same_as);

/// Keeps the order of the vertices that stay. For each new vertex its old index is returned. Wrong indices stay wrong.
std::vector<Index> removeUnusedVertices(TriangleMesh& mesh);

}  // namespace palpate::mesh
