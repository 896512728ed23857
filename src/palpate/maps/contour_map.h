// The contour map: which irregular deformation boundary belongs to which place on the back.
//
// The sibling of ellipse_map.h for polar contours: the logarithms of the radii, direction by direction, interpolated by
// GRI over a basic circle. Directions need no blending: every contour starts at the same +x.
// Based on: Ji, dissertation 2008, sections 5.2 and 6.2.
#pragma once

#include <span>
#include <vector>

#include "palpate/maps/contour_points.h"
#include "palpate/maps/ellipse_map.h"
#include "palpate/maps/polar_contour.h"

namespace palpate::maps {

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
