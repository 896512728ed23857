// The contour map: which irregular deformation boundary belongs to which place on the back.
//
// The sibling of ellipse_map.h for polar contours: the logarithms of the radii, direction by direction, interpolated by
// GRI over a basic circle. Directions need no blending: every contour starts at the same +x.
// Based on: Ji, dissertation 2008, sections 5.2 and 6.2.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/maps/ellipse_map.h"
#include "palpate/maps/key_points.h"
#include "palpate/maps/polar_contour.h"

namespace palpate::maps {

/// A place on the back where an irregular boundary was measured.
///
/// A table has one row per point: name,x_mm,y_mm,r0_mm,r1_mm,... with 3 to 64 radii at equal angles from +x,
/// counter-clockwise (r1 of 8 radii is at 45 degree), the same number in every row. The first row may name the
/// columns. x and y are the body frame's, seen along z.
struct ContourPoint {
  std::string name;
  Vec2 position_mm = Vec2::Zero();
  PolarContour contour;
};

/// An empty table is fine: no points. Throws Error with the line for a wrong number of fields, a header with other
/// names, anything that is not a finite number, a radius outside 0.001 to 10,000 mm.
std::vector<ContourPoint> readContourPoints(const std::filesystem::path& file);
std::vector<ContourPoint> parseContourPoints(std::string_view text, std::string_view file);

/// The ellipses of key points as contours; key points without an ellipse are left out.
std::vector<ContourPoint> contourPointsOf(std::span<const KeyPoint> keys, std::size_t radii = kMaxContourRadii);

class PolarContourMap {
 public:
  /// Points with an empty contour are left out. Throws Error if the basic radius is not a positive number or the points
  /// have different numbers of radii.
  explicit PolarContourMap(std::span<const ContourPoint> points, const EllipseMapSettings& settings = {});

  /// The contour at a place of the map plane (body frame x, y in mm), with as many radii as the points have (64 without
  /// any). O(number of points x 64), no allocation.
  PolarContour at(double x_mm, double y_mm) const noexcept;

  /// The contour at a surface point, on its tangent plane.
  SurfaceContour on(const Vec3& point, const Vec3& normal) const noexcept;

  std::size_t radii() const noexcept { return radii_; }

 private:
  std::vector<ContourPoint> points_;
  std::size_t radii_ = kMaxContourRadii;
  double log_basic_radius_;
  double effect_radius_mm_;
};

}  // namespace palpate::maps
