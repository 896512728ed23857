// The skin of the trunk before it is cut into triangles: the zero of a smooth function of space, closed all round.
//
// Fitted by tools/fit_trunk.py to the signed distance of a real human shape (trunk_table.h): a cubic B-spline over a
// lattice of 18 mm, mirrored at x = 0. Unlike a radius about an axis (skin_surface.h) it follows armpits, arms and
// thighs. trunk_mesher.h walks on it; everything that makes one body differ from another comes after (trunk.h).
// Millimetre of a man of 1750 mm, body frame. Immutable; any thread.
#pragma once

#include <vector>

#include "palpate/base/vec.h"
#include "palpate/body/skin_surface.h"

namespace palpate::body {

class TrunkField {
 public:
  /// Reads the built-in table; under a millisecond.
  TrunkField();

  struct Value {
    double distance;  ///< about the distance to the skin within 30 mm of it, negative inside; farther only the sign
    Vec3 gradient;    ///< about a unit vector out of the body near the skin
  };
  Value at(const Vec3& point) const;

  /// The point of the skin along the gradient from a place within about 25 mm of it.
  SkinPoint project(const Vec3& point) const;

  /// The way in which fat grows at a point of the skin: out of a body that is some way outside, so that it fills small
  /// hollows instead of closing over them.
  Vec3 outward(const SkinPoint& point) const;

  /// A box that holds the trunk with room to spare.
  static Eigen::AlignedBox3d box();

 private:
  std::vector<double> coefficients_;
};

}  // namespace palpate::body
