// The twelve right ribs; the left ones are their mirror images.
#pragma once

#include <vector>

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::body {

inline constexpr int kRibCount = 12;

/// The right rib `number` in 1..12 in the body frame, closed; rings and corners follow the wanted edge length.
mesh::TriangleMesh makeRightRib(int number, double edge_mm);

/// The point of the right rib's outer face at its angle, where the shaft turns forwards.
Vec3 rightRibAngle(int number);

}  // namespace palpate::body
