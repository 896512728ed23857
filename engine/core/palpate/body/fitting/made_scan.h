// A back as a scanner of surfaces leaves it, for trying without one: an open skin without bones, rough by the scanner's
// noise, with a ragged border and with a hole where the scanner saw nothing. Deterministic.
#pragma once

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::body {

/// Some 12,000 triangles; about a second, for the bones whose relief shows. The hole is some 60 mm wide, below the
/// right shoulder blade: too large to be filled (mesh/repair.h).
mesh::TriangleMesh makeScan();

}  // namespace palpate::body
