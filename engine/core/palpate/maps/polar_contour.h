// An irregular deformation boundary: a closed contour round the touched point, given by its radius in each direction.
//
// A measured boundary (a polyline of equal displacement) is not an ellipse; a polar contour keeps its shape. It may
// replace the ellipse in the deformation: both return the location ratio of an offset, 0 at the centre and 1
// on the boundary. Based on: Ji, dissertation 2008, section 6.2 (irregular deformation boundaries as future work);
// Catmull, Rom, "A class of local interpolating splines", 1974.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "palpate/maps/ellipse.h"

namespace palpate::maps {

/// Three radii are the fewest that close round a point; 64 put one every 5.6 degree, finer than dots 30 mm apart
/// resolve.
inline constexpr std::size_t kMinContourRadii = 3;
inline constexpr std::size_t kMaxContourRadii = 64;

/// Star-shaped about its centre. Plain data of a fixed size: copying never allocates.
struct PolarContour {
  /// Radii in use, 3 to 64; 0 is an empty contour.
  std::size_t count = 0;
  /// Natural logarithm of the radius in mm at the angle 2 pi i / count from +x, counter-clockwise. Logarithms, because
  /// blends and interpolations of them stay positive radii.
  std::array<double, kMaxContourRadii> log_radii{};
};

/// Throws Error for a number of radii outside 3 to 64, or a radius that is not a positive number.
PolarContour contourOf(std::span<const double> radii_mm);

/// The ellipse as a contour. Between its radii it errs by less than 0.1 % for 32 or more of them and an aspect of 0.7
/// or more (docs/explanation/maps.md has the table). An empty ellipse gives an empty contour. Throws Error as above.
PolarContour contourOf(const Ellipse& ellipse, std::size_t radii = kMaxContourRadii);

/// Radius in mm in a direction of the map plane, exactly the given one where the contour has one. Between them a
/// periodic Catmull-Rom curve through the logarithms: smooth (C1) all round, always above 0. 0 for an empty contour.
double radiusAt(const PolarContour& contour, double angle_rad) noexcept;

/// Location ratio q of an offset: distance / radius in that direction. An empty contour returns 0 at its centre and
/// infinity elsewhere, like an empty ellipse.
double locationRatio(const PolarContour& contour, const Vec2& offset) noexcept;

/// A contour in the tangent plane of the surface.
struct SurfaceContour {
  PolarContour contour;
  Vec3 axis_x = Vec3::UnitX();  ///< unit; where the contour's angles start
  Vec3 axis_y = Vec3::UnitY();  ///< unit, across axis_x in the tangent plane
};

/// The map's contour laid undistorted on the tangent plane of a surface point: its x axis keeps the direction seen
/// along z (E32, as for ellipses), y follows at right angles. A normal that is not finite or is zero makes an empty
/// contour.
SurfaceContour contourOnSurface(const PolarContour& contour, const Vec3& normal) noexcept;

/// Location ratio of a point whose offset from the centre is in the contour's plane.
double locationRatio(const SurfaceContour& contour, const Vec3& offset_in_plane) noexcept;

}  // namespace palpate::maps
