// Who is next to whom: compressed adjacency of a triangle mesh.
//
// Built once at load from TriangleMesh; read by normals, repair, contact (triangle -> triangles) and deform (rings).
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

}  // namespace palpate::mesh
