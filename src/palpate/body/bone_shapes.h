// The shapes of the bones, one at a time and before they are reduced: vertebra.cpp, ribs.cpp, scapula.cpp.
//
// makeBones (bones.h) calls them, reduces what comes, mirrors it and puts it in its place. Only right sides are drawn:
// a vertebra is its right half, and the left ribs and scapula are mirror images. Millimetres of a man of 1750 mm.
#pragma once

#include "palpate/body/spine_line.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::body {

// Vertebrae: body, pedicles, laminae, facets, transverse processes, canal and spinous process.

/// The right half (x >= 0) in the vertebra's own frame, open only in the plane x = 0. `cell_mm` is the mesher's grid.
mesh::TriangleMesh makeVertebraHalf(const VertebraRow& row, double cell_mm);

/// Centre of the rounded tip of the transverse process, right side, own frame.
Vec3 transverseTip(const VertebraRow& row);

/// The dorsal end of the spinous process, own frame, x = 0.
Vec3 spinousTip(const VertebraRow& row);

// Ribs.

inline constexpr int kRibCount = 12;

/// The right rib `number` in 1..12 in the body frame, closed; rings and corners follow the wanted edge length.
mesh::TriangleMesh makeRightRib(int number, double edge_mm);

/// The point of the right rib's outer face at its angle, where the shaft turns forwards.
Vec3 rightRibAngle(int number);

// Scapula.

/// The closed right scapula in the body frame, at rest on the back of a man of 1750 mm.
mesh::TriangleMesh makeRightScapula(double cell_mm);

/// Points that are palpated on the right scapula, on its surface, body frame.
struct ScapulaPoints {
  Vec3 superior_angle, spine_root, inferior_angle, acromial_angle;
};
ScapulaPoints rightScapulaPoints();

}  // namespace palpate::body
