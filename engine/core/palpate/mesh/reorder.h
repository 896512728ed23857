// Spatial order: neighbours in space become neighbours in memory, for vertices and for triangles.
//
// Once after load or repair; every later pass (normals, trees, deformation ranges) reads memory in runs. Triangles
// follow Morton's curve. Vertices are split at the median into compact groups instead: a space-filling curve leaves a
// surface and returns to it elsewhere, so that runs of its order fall into pieces and lie in boxes much wider than the
// pieces. Groups by the median have boxes about half as wide, nine in ten of them over one connected piece of skin.
#pragma once

#include <span>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::mesh {

/// Points in a group. Groups come in groups of as many groups again, as compact: runs of 64 and of 4,096 points.
inline constexpr Index kCompactGroup = 64;

/// The given points (indices into `points`), sorted into groups; within a group they keep their order. Deterministic on
/// every machine: equal coordinates are distinguished by place in `order`. NaN and infinity count as 0.
std::vector<Index> inCompactGroups(std::span<const Vec3> points, std::span<const Index> order);

/// For each new index the old one.
struct Reordering {
  std::vector<Index> source_vertex;
  std::vector<Index> source_triangle;
};

/// Sorts triangles by the Morton code of their centre and vertices into compact groups; unused vertices come last.
/// Indices must be within range. The surface and every winding stay the same.
Reordering reorderSpatially(TriangleMesh& mesh);

/// The mean of the corners of each triangle, mm.
std::vector<Vec3> triangleCentres(const TriangleMesh& mesh);

/// The order that sorts points along the Morton curve of their box; ties keep their order.
std::vector<Index> mortonOrder(std::span<const Vec3> points);

}  // namespace palpate::mesh
