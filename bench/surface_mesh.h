// The mesh that a contact surface was built from.
#pragma once

#include "palpate/contact/surface.h"

namespace palpate::bench {

/// The repaired mesh, in the surface's units, its triangles in their own order.
mesh::TriangleMesh meshOf(const contact::Surface& surface);

}  // namespace palpate::bench
