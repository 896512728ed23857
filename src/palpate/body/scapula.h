// The right scapula; the left one is its mirror image.
#pragma once

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::body {

/// The closed right scapula in the body frame, at rest on the back of a man of 1750 mm.
mesh::TriangleMesh makeRightScapula(double cell_mm);

/// Points that are palpated on the right scapula, on its surface, body frame.
struct ScapulaPoints {
  Vec3 superior_angle, spine_root, inferior_angle, acromial_angle;
};
ScapulaPoints rightScapulaPoints();

}  // namespace palpate::body
