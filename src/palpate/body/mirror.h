// The right half makes the left: exact mirror images across the plane x = 0.
#pragma once

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::body {

/// The same mesh with x negated and the winding turned, so that it still faces outwards.
mesh::TriangleMesh mirrored(mesh::TriangleMesh mesh);

/// The half x >= 0 and its mirror image, joined along the vertices with x == 0 exactly. Closed when the half is closed
/// but for a border in that plane.
mesh::TriangleMesh withMirrorImage(mesh::TriangleMesh half);

}  // namespace palpate::body
