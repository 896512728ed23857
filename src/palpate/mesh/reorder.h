// Spatial order: what is near in space becomes near in memory, for vertices and for triangles.
//
// Once after load or repair; every later pass (normals, trees, deformation ranges) reads memory in runs.
// Based on: Morton, "A computer oriented geodetic data base", 1966 (interleaved bits), on a 2^21 lattice per axis.
#pragma once

#include <span>
#include <vector>

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::mesh {

/// For each new index the old one.
struct Reordering {
  std::vector<Index> source_vertex;
  std::vector<Index> source_triangle;
};

/// Sorts triangles by the Morton code of their centre and vertices into compact groups (compact_groups.h); unused
/// vertices come last. Indices must be within range. The surface and every winding stay the same.
Reordering reorderSpatially(TriangleMesh& mesh);

/// The mean of the corners of each triangle, mm.
std::vector<Vec3> triangleCentres(const TriangleMesh& mesh);

/// The order that sorts points along the Morton curve of their box; ties keep their order.
std::vector<Index> mortonOrder(std::span<const Vec3> points);

}  // namespace palpate::mesh
