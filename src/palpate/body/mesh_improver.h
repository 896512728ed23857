// Gives the triangles near the border of a flat mesh a better shape without changing their number.
#pragma once

#include "palpate/body/outline_mesher.h"
#include "palpate/body/tetrahedra_mesher.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::body {

// Evens out a mesher's triangles without leaving the surface.

/// Moves every vertex towards the middle of its neighbours along the surface and back onto the zero of the field,
/// `rounds` times: the lattice's slivers and the steps they draw along round edges disappear. Vertices with x == 0
/// exactly stay in that plane, as the border of a half that will be mirrored must.
void relaxOnSurface(mesh::TriangleMesh& mesh, const Field& field, int rounds);

/// Flips edges and moves inner vertices within a few rings of the border, judged by the shape of the lifted triangles.
/// Border vertices stay. Time proportional to the border after one pass over the mesh.
void improveBand(FlatMesh& mesh, const Lift& lift);

}  // namespace palpate::body
