// One vertebra as a mesh: body, pedicles, laminae, facets, transverse processes, canal and spinous process.
#pragma once

#include "palpate/body/spine_line.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::body {

/// The right half (x >= 0) in the vertebra's own frame, open only in the plane x = 0. `cell_mm` is the mesher's grid.
mesh::TriangleMesh makeVertebraHalf(const VertebraRow& row, double cell_mm);

/// Centre of the rounded tip of the transverse process, right side, own frame.
Vec3 transverseTip(const VertebraRow& row);

/// The dorsal end of the spinous process, own frame, x = 0.
Vec3 spinousTip(const VertebraRow& row);

}  // namespace palpate::body
