// The hand that is drawn where the device points: open, with the index finger stretched out.
#pragma once

#include <cstddef>

#include "palpate/mesh/triangle_mesh.h"

namespace palpate::body {

enum class Side : unsigned char { left, right };

struct HandSettings {
  Side side = Side::right;
  std::size_t triangles = 2800;  ///< exact; even, at least 200
  double length_mm = 221.0;      ///< from the cut through the wrist to the tip of the index finger
};

/// A closed hand in one piece. Own frame: fingers along +y, back of the hand +z, thumb of the right hand towards -x
/// (its left seen from the back), origin in the middle of the wrist. Right and left are mirror images. Throws Error on
/// wrong settings.
mesh::TriangleMesh makeHand(const HandSettings& settings = {});

/// The tip of the index finger in the hand's frame: the point to lay on the device's point.
Vec3 indexTip(const HandSettings& settings = {});

}  // namespace palpate::body
