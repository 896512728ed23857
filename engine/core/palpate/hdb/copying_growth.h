// Cutting a triangle along an axis-aligned plane: case A of the assignment.
//
// Based on: Sutherland, Hodgman, "Reentrant polygon clipping" (1974).
#pragma once

#include <array>

#include "palpate/base/vec.h"

namespace palpate::hdb {

struct AxisPlane {
  int axis = 0;     ///< 0, 1, 2: x, y, z
  double at = 0.0;  ///< mm
};

/// Up to two triangles: what is left of one on one side of a plane.
struct Pieces {
  std::array<std::array<Vec3, 3>, 2> triangles;
  int count = 0;
};

/// The part of the triangle on the plane or on its positive (negative) side, wound as the triangle. A triangle that
/// only touches the plane with a corner or an edge leaves nothing on the other side; one that lies in the plane is on
/// both. New corners lie exactly on the plane and are the same bits seen from both sides and from both triangles of an
/// edge.
Pieces clip(const std::array<Vec3, 3>& triangle, const AxisPlane& plane, bool positive);

}  // namespace palpate::hdb
