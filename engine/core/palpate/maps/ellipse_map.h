// The ellipse map: the deformation ellipse of each place on the back.
//
// Interpolates the ellipses of key points (log-Euclidean GRI) over a basic circle. `deform` queries it at the friction
// anchor; whole maps per vertex are for pictures and for engines that want a table.
// Based on: Ji, dissertation 2008, sections 5.2 and 5.3, with E26 to E29 and E32.
#pragma once

#include <span>
#include <vector>

#include "palpate/maps/key_points.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::maps {

struct EllipseMapSettings {
  /// Reach of a key point in the map plane. 200 mm reproduces the dissertation's Table 5.1, which prints the
  /// diameter 400 (E28).
  double effect_radius_mm = 200.0;
  /// Radius of the circle outside the reach of key points. The dissertation never gives it for the back (E33);
  /// 150 mm is the geometric mean of its seven key ellipses, rounded.
  double basic_radius_mm = 150.0;
};

class EllipseMap {
 public:
  /// Key points with an empty ellipse are left out. Throws Error if the basic radius is not a positive number.
  explicit EllipseMap(std::span<const KeyPoint> keys, const EllipseMapSettings& settings = {});

  /// The ellipse at a place of the map plane (body frame x, y in mm). O(number of key points), no allocation.
  Ellipse at(double x_mm, double y_mm) const noexcept;

  /// The ellipse at a surface point, on its tangent plane.
  SurfaceEllipse on(const Vec3& point, const Vec3& normal) const noexcept;

 private:
  struct Key {
    Vec2 position;
    LogTensor tensor;
  };
  std::vector<Key> keys_;
  LogTensor base_;
  double effect_radius_mm_;
};

}  // namespace palpate::maps
