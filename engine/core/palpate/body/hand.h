// Two hands: an open one with the index finger stretched out, as a model of any size, and the one that is drawn where a
// finger touches: it palpates, and has its forearm. And the end of a finger alone, which is drawn in its place.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

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

/// A nail: a plate round `centre`, in the directions of `along` (to the tip), `across` and `up` (out of the finger),
/// each as long as half of it.
struct Nail {
  Vec3 centre, along, across, up;
};

/// A hand that presses with the pad of its index finger: that one bent a little down, the others nearly straight and
/// held off, the thumb at the side, the wrist bent back, and 260 mm of forearm. Frame as above.
struct PalpatingHand {
  mesh::TriangleMesh mesh;         ///< closed, about 10,000 triangles
  std::vector<float> redness;      ///< one per vertex, 0 to 1: over the joints, at the tips
  std::array<Nail, 5> nails;       ///< thumb, index finger and on
  Vec3 pad = Vec3::Zero();         ///< in the middle of the last joint's pulp
  Vec3 pad_along = Vec3::UnitY();  ///< unit, of the last joint of the index finger towards its tip
  Vec3 forearm = -Vec3::UnitY();   ///< unit, from the wrist (the origin) to the elbow
  double forearm_mm = 260.0;       ///< where its end is cut, along that
  double band_mm = 34.0;           ///< middle of the band in the hand's colour, along that
  double band_half_mm = 8.0;       ///< half of the band's width
};

/// The left one is the mirror image of the right. Takes some tenths of a second.
PalpatingHand makePalpatingHand(Side side);

/// The radius of the fingertip below.
inline constexpr double kFingertipMm = 8.0;

/// A finger without its hand: the last joint and half of the one before, in a sleeve that is the band. The origin is
/// the last joint; only the index finger has a nail. Some 900 triangles, made in no time.
PalpatingHand makePalpatingFinger();

}  // namespace palpate::body
