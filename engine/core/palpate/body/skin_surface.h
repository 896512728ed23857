// The skin of the back as a smooth surface: position and normal at any (angle, y), before it is cut into triangles.
//
// One scalar, the radius about a cranio-caudal axis, from the fitted table plus a layer of detail (skin_relief), bent
// by the natural asymmetry and scaled to the stature. Read by the meshing of the back and the torso and by the
// construction of the bones, which must lie under it. Millimetre, body frame (design of vec.h); immutable, any thread.
#pragma once

#include "palpate/base/vec.h"
#include "palpate/body/bicubic_spline.h"

namespace palpate::body {

/// The slight natural asymmetry of a back: a sway of the midline and a lower right shoulder. A smooth warp of space, so
/// that the skin and the bones under it move together and the covers stay. Bulges of the paraspinal muscles, which move
/// the skin alone, are a part of skin_relief.
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

/// Warps a point of the body (mm, body frame).
Warped warp(const Asymmetry& asymmetry, const Vec3& point);

/// A point of the skin: angle about the axis (rad, positive to the right) and height (mm), both of the table's
/// man of 1750 mm whatever the stature.
struct SkinAngle {
  double angle = 0;
  double y = 0;
};

struct SkinPoint {
  Vec3 position;
  Vec3 normal;  ///< unit, out of the body
};

class SkinSurface {
 public:
  /// The fitted surface alone, symmetric, for a stature in mm.
  explicit SkinSurface(double stature_mm = 1750.0);
  /// `detail` is added to the radius, mm over the spline's unit square (see unitPlace); `asymmetry` bends the result.
  SkinSurface(double stature_mm, BicubicSpline detail, const Asymmetry& asymmetry);

  SkinPoint at(const SkinAngle& place) const;
  /// z of the symmetric, unbent skin over (x, y) in mm of this stature; found by walking the angle. x within +-135 mm
  /// and y within [-292, 200] mm of a man of 1750 mm, where the skin is a height field.
  double heightOver(double x, double y) const;
  /// Stature / 1750: factor from the table's millimetres to this body's.
  double scale() const { return scale_; }

 private:
  SplineValue radius(const SkinAngle& place) const;

  double scale_;
  BicubicSpline base_;
  BicubicSpline detail_;
  Asymmetry asymmetry_;
};

/// The place of a unit-square coordinate of the skin's splines, and back.
SkinAngle placeOfUnit(double u, double v);
Vec2 unitOfPlace(const SkinAngle& place);

}  // namespace palpate::body
