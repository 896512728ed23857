// Gives the triangles near the border of a flat mesh a better shape without changing their number.
#pragma once

#include "palpate/body/outline_mesher.h"

namespace palpate::body {

/// Flips edges and moves inner vertices within a few rings of the border, judged by the shape of the lifted triangles.
/// Border vertices stay. Time proportional to the border after one pass over the mesh.
void improveBand(FlatMesh& mesh, const Lift& lift);

}  // namespace palpate::body
