// A closed smooth surface in triangles of about one size and shape, exactly as many as wanted.
//
// trunk_field.h -> here -> trunk.h. A rough closed mesh is made even by splitting long edges, collapsing short
// ones, flipping towards six neighbours and moving vertices to the middle of theirs; finer meshes are that one with
// every triangle cut in four, so that millions cost no more than the projection of their vertices.
#pragma once

#include <cstddef>
#include <functional>

#include "palpate/body/skin_surface.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::body {

/// The point of the surface near a place that is not farther from it than an edge is long.
using OntoSurface = std::function<SkinPoint(const Vec3&)>;

/// `rough`: closed, manifold, outward, near the surface, finer than its features. Exactly `triangles` triangles, which
/// is an even number; deterministic. Throws Error when the surface cannot be followed with so few.
mesh::TriangleMesh evenMesh(const mesh::TriangleMesh& rough, const OntoSurface& onto, std::size_t triangles);

}  // namespace palpate::body
