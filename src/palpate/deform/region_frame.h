// A region of any shape, made ready for vertices: location ratio and its slope for an offset from the anchor.
//
// FormDeformer makes two per contact, for the press and for the drag. Offsets are projected along the contact's normal
// (4.9) by taking their parts along the two axes.
#pragma once

#include "palpate/deform/forms.h"
#include "palpate/deform/pedal_ellipse.h"

namespace palpate::deform {

struct RegionFrame {
  enum class Kind : std::uint8_t { none, ellipse, pedal, contour };
  Kind kind = Kind::none;       ///< none: moves nothing
  Vec3 along = Vec3::Zero();    ///< unit; major axis, or where a contour's angles start
  Vec3 across = Vec3::Zero();   ///< unit, in the tangent plane too
  double half_along_mm = 0.0;   ///< of ellipse and pedal
  double half_across_mm = 0.0;  ///< longer than half_along where the ratio is taken the wrong way round (E15)
  maps::PolarContour contour;

  bool acts() const { return kind != Kind::none; }
};

/// The ellipse (circle, pedal curve) on the tangent plane of the unit normal; kind none for one without area.
RegionFrame ellipseFrame(const maps::SurfaceEllipse& ellipse, const Vec3& unit_normal,
                         const FormSettings& forms) noexcept;

/// The contour; kind none for an empty one.
RegionFrame contourFrame(const maps::SurfaceContour& contour, const Vec3& unit_normal) noexcept;

/// Parts of an offset along the region's axes, mm.
inline Vec2 inPlane(const RegionFrame& region, const Vec3& offset) noexcept {
  return {region.along.dot(offset), region.across.dot(offset)};
}

/// Where a point lies. A region that does not act has everything outside. No allocation.
Location locate(const RegionFrame& region, const Vec2& offset) noexcept;

}  // namespace palpate::deform
