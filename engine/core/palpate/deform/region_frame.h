// A region of any shape, made ready for vertices: location ratio and its slope for an offset from the anchor.
//
// The general displacement makes two per contact, for the press and for the drag. Offsets are projected along the
// contact's normal (4.9) by taking their parts along the two axes; far off the plane the ratio grows with the height
// (Rise), except as printed (E23).
//
// The ellipse as printed (E14) takes the eccentric angle for the polar one, so that q = 1 is the pedal curve
// r^2 = a^2 cos^2 + b^2 sin^2: it touches the ellipse on its axes and reaches beyond it everywhere else, by up to
// (T + 1/T)/2 (7 % for the measured ratios), and is dented for T > sqrt(2).
// Based on: Ji, dissertation 2008, section 4.4, (4.7) to (4.14), with E14 and E15.
#pragma once

#include <cmath>

#include "palpate/deform/forms.h"
#include "palpate/deform/frame.h"

namespace palpate::deform {

/// A location ratio and how it grows per mm along the two axes of the region.
struct Location {
  double q = 0.0;
  Vec2 slope = Vec2::Zero();
};

/// (4.13) for an offset (u, v) in mm along and across the axis of length `half_axis`; `t` is b/a. 0 at the centre,
/// where the printed form is 0/0.
inline Location pedalLocation(double half_axis, double t, const Vec2& offset) noexcept {
  const double distance2 = offset.squaredNorm();
  if (!(distance2 > 0.0)) return {};
  const Vec2 stretched(offset.x(), t * t * offset.y());
  const double root = std::sqrt(offset.dot(stretched));
  const double q = distance2 / (half_axis * root);
  return {q, 2.0 * offset / (half_axis * root) - q / (root * root) * stretched};
}

struct RegionFrame {
  enum class Kind : std::uint8_t { none, ellipse, pedal, contour };
  Kind kind = Kind::none;       ///< none: moves nothing
  Vec3 along = Vec3::Zero();    ///< unit; major axis, or where a contour's angles start
  Vec3 across = Vec3::Zero();   ///< unit, in the tangent plane too
  double half_along_mm = 0.0;   ///< half axis of ellipse and pedal
  double half_across_mm = 0.0;  ///< longer than half_along where the ratio is taken the wrong way round (E15)
  Rise rise;
  maps::PolarContour contour;

  bool acts() const { return kind != Kind::none; }
};

/// The ellipse (circle, pedal curve) on the tangent plane of the unit normal; kind none for one without area.
RegionFrame ellipseFrame(const maps::SurfaceEllipse& ellipse, const Vec3& unit_normal, const FormSettings& forms,
                         double level_mm = kFlatLevelMm) noexcept;

/// The contour; kind none for an empty one.
RegionFrame contourFrame(const maps::SurfaceContour& contour, const Vec3& unit_normal, const FormSettings& forms = {},
                         double level_mm = kFlatLevelMm) noexcept;

/// Parts of an offset along the region's axes, mm.
inline Vec2 inPlane(const RegionFrame& region, const Vec3& offset) noexcept {
  return {region.along.dot(offset), region.across.dot(offset)};
}

/// Where a point lies, seen along the normal. A region that does not act has everything outside. No allocation.
Location locate(const RegionFrame& region, const Vec2& offset) noexcept;

/// A location ratio and how it grows per mm in space.
struct SpatialLocation {
  double q = 0.0;
  Vec3 slope = Vec3::Zero();
};

/// Where a point lies, its height over the plane included. No allocation.
SpatialLocation locateInSpace(const RegionFrame& region, const Vec3& offset) noexcept;

/// The longest and the shortest radius, mm.
double longestRadius(const RegionFrame& region) noexcept;
double shortestRadius(const RegionFrame& region) noexcept;

}  // namespace palpate::deform
