// Evens out a mesher's triangles without leaving the surface.
#pragma once

#include "palpate/body/tetrahedra_mesher.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::body {

/// Moves every vertex towards the middle of its neighbours along the surface and back onto the zero of the field,
/// `rounds` times: the lattice's slivers and the steps they draw along round edges disappear. Vertices with x == 0
/// exactly stay in that plane, as the border of a half that will be mirrored must.
void relaxOnSurface(mesh::TriangleMesh& mesh, const Field& field, int rounds);

}  // namespace palpate::body
