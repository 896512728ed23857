// Shapes that no bar was tuned on: for fuzzing the finger and for looking where it is weak.
//
// Closed bodies are counter-clockwise seen from outside; the others are open sheets over z (workload_meshes.h). In mm.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::lab {

/// A ring round z; `around` x `across` cells.
mesh::TriangleMesh torusMesh(double ring_radius_mm, double tube_radius_mm, int around, int across);

/// A star-shaped ball: an octahedron cut `level` times (8 * 4^level triangles), with bumps of +-`bump` times the
/// radius.
mesh::TriangleMesh bumpyBallMesh(double radius_mm, double bump, double bumps_around, int level);

/// A closed plate of size x size x thickness, `cells` squares along each side; rims are one cell high.
mesh::TriangleMesh plateMesh(double size_mm, double thickness_mm, int cells);

/// Two balls that overlap without being united: a self-intersecting surface.
mesh::TriangleMesh overlappingBallsMesh();

/// Two boxes that share one edge: a non-manifold edge, as two bodies that touch have it.
mesh::TriangleMesh touchingBoxesMesh();

/// The shape of that name; throws Error for another.
mesh::TriangleMesh heldoutMesh(std::string_view name);

/// ring, ball, plate2mm, plate_thick, saddle, cliffs, terrain, spikes, slivers, ridge, tiny (0.01 mm), huge (100 m).
std::vector<std::string> heldoutMeshNames();

}  // namespace palpate::lab
