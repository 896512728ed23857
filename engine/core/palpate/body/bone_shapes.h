// The shapes of the bones, one at a time and before they are reduced: vertebra.cpp, ribs.cpp, scapula.cpp.
//
// makeBones (bones.h) calls them, reduces what comes, mirrors it and puts it in its place. Only right sides are drawn:
// a vertebra is its right half, and the left ribs and scapula are mirror images. Millimetres of a man of 1750 mm.
#pragma once

#include <span>

#include "palpate/body/spine_line.h"
#include "palpate/body/swept_ellipse.h"
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

/// The course of a rib from its vertebra (spine_line.h) to its anterior end, millimetres.
struct RibRow {
  double angle_x, angle_drop, angle_z;           // the angle: y below the head, z in the body frame
  double half_width, lateral_drop, lateral_z;    // the most lateral point: outer edge; y and z from the head
  double anterior_x, anterior_drop, anterior_z;  // the anterior end: y and z from the head
  double height, thickness;                      // the section
  double roll_deg;                               // how far the outer face looks up: the first rib is flat
};

/// Ribs 1 to 12 of the back and the torso.
std::span<const RibRow, kRibCount> ribRows();

/// The right rib `number` in 1..12 in the body frame, closed; rings and corners follow the wanted edge length.
mesh::TriangleMesh makeRightRib(int number, const RibRow& row, double edge_mm, SweptEnd anterior = {});

/// The last section of that rib before its anterior end is closed: where a costal cartilage begins.
Station rightRibEnd(int number, const RibRow& row, double edge_mm);

/// The point of the right rib's outer face at its angle, where the shaft turns forwards.
Vec3 rightRibAngle(int number, const RibRow& row);

// Scapula.

/// Place of the scapula's own frame (u lateral along its spine, v cranial, n dorsal): the root of its spine and turns
/// about u (upper border forwards), n (lateral side up) and y (lateral side forwards).
struct ScapulaPlace {
  Vec3 root;
  double tilt_deg, upward_deg, internal_deg;
};

/// Solved for the depths under the skin of the back (root 9.4 mm, inferior angle 11.6, acromion at least 4).
inline const ScapulaPlace kScapulaPlaceOfBack{{76.0, 98.0, 94.5}, 10.5, 0.5, 41.6};

Eigen::Isometry3d scapulaFrame(const ScapulaPlace& place);

/// The closed right scapula in the body frame, at rest on the back of a man of 1750 mm.
mesh::TriangleMesh makeRightScapula(double cell_mm, const ScapulaPlace& place = kScapulaPlaceOfBack);

/// Points that are palpated on the right scapula, on its surface, body frame.
struct ScapulaPoints {
  Vec3 superior_angle, spine_root, inferior_angle, acromial_angle;
};
ScapulaPoints rightScapulaPoints(const ScapulaPlace& place = kScapulaPlaceOfBack);

}  // namespace palpate::body
