// The slight natural asymmetry of a back: a sway of the midline and a lower right shoulder.
//
// A smooth warp of space, so that the skin and the bones under it move together and the covers stay. Bulges of the
// paraspinal muscles, which move the skin alone, are a part of skin_relief.
#pragma once

#include "palpate/base/vec.h"

namespace palpate::body {

struct Asymmetry {
  double amount = 0;            ///< factor on everything below; 0 is a symmetric body, 1 a natural one
  double sway_mm = 2.5;         ///< largest sideways shift of the midline, to the right at the shoulder blades
  double shoulder_drop_mm = 5;  ///< how much lower the right shoulder blade sits
  double stature_scale = 1;     ///< stature / 1750: lengths above and in the shape of the warp grow with it
};

struct Warped {
  Vec3 position;
  Mat3 jacobian;  ///< derivative of the position after the warp by the position before
};

/// Where the warp takes a point of the body (mm, body frame).
Warped warp(const Asymmetry& asymmetry, const Vec3& point);

}  // namespace palpate::body
