// Neighbourhood of triangles and vertices: compressed adjacency of a triangle mesh.
//
// Built once at load from TriangleMesh; read by normals, repair, contact (triangle -> triangles) and deform (rings).
// All of it is linear in the number of triangles except for short sorts within one vertex. Indices must be within
// range.
#pragma once

#include <span>
#include <vector>

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::mesh {

/// Rows of varying length in two flat arrays (compressed sparse rows).
struct IndexRows {
  std::vector<Index> offsets;  ///< rows + 1 entries
  std::vector<Index> entries;
  std::span<const Index> operator[](Index row) const {
    return {entries.data() + offsets[row], entries.data() + offsets[row + 1]};
  }
  Index rows() const { return offsets.empty() ? 0 : static_cast<Index>(offsets.size() - 1); }
};

/// Triangles that use each vertex, ascending.
IndexRows trianglesOfVertices(const TriangleMesh& mesh);

/// Vertices joined to each vertex by an edge, ascending, without repeats.
IndexRows neighboursOfVertices(const TriangleMesh& mesh, const IndexRows& triangles_of_vertices);

/// For each triangle the triangle across its edge i = (corner i, corner i + 1 mod 3); kNoIndex at a border and at an
/// edge that is not shared by exactly two triangles of opposite direction.
std::vector<std::array<Index, 3>> neighboursOfTriangles(const TriangleMesh& mesh);

/// A half-edge is a triangle's own side of an edge: 3 * triangle + i, from corner i to corner i + 1 mod 3.
inline Index halfEdgeStart(const TriangleMesh& mesh, Index half_edge) {
  return mesh.triangles[half_edge / 3][half_edge % 3];
}
inline Index halfEdgeEnd(const TriangleMesh& mesh, Index half_edge) {
  return mesh.triangles[half_edge / 3][(half_edge % 3 + 1) % 3];
}

/// One half-edge, filed under the lower one of its two vertices.
struct EdgeUse {
  Index high;  ///< the other vertex
  Index half_edge;
};

/// All half-edges, grouped by undirected edge: within the row of vertex `low` sorted by (high, half_edge). A side whose
/// two corners are one vertex is left out.
struct EdgeUses {
  std::vector<Index> offsets;
  std::vector<EdgeUse> uses;
};

EdgeUses edgeUses(const TriangleMesh& mesh);

/// How many more of an edge's triangles run along it from its vertex `low` on than to it: 0 where their directions
/// cancel.
inline int edgeBalance(const TriangleMesh& mesh, Index low, std::span<const EdgeUse> uses) {
  int balance = 0;
  for (const EdgeUse& use : uses) balance += halfEdgeStart(mesh, use.half_edge) == low ? 1 : -1;
  return balance;
}

/// Calls visit(low, high, span of EdgeUse) for every undirected edge, in ascending order.
template <class Visit>
void forEachEdge(const EdgeUses& edges, const Visit& visit) {
  for (Index low = 0; low + 1 < edges.offsets.size(); ++low) {
    for (Index first = edges.offsets[low]; first < edges.offsets[low + 1];) {
      Index end = first + 1;
      while (end < edges.offsets[low + 1] && edges.uses[end].high == edges.uses[first].high) ++end;
      visit(low, edges.uses[first].high, std::span<const EdgeUse>(&edges.uses[first], end - first));
      first = end;
    }
  }
}

}  // namespace palpate::mesh
