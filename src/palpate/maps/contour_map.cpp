#include "palpate/maps/contour_map.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "palpate/base/error.h"
#include "palpate/maps/gaussian_interpolation.h"

namespace palpate::maps {

namespace {

/// All logarithms of a contour at once. Unused ones are carried along: a fixed size needs no allocation.
using LogRadii = Eigen::Matrix<double, static_cast<int>(kMaxContourRadii), 1>;

}  // namespace

PolarContourMap::PolarContourMap(std::span<const ContourPoint> points, const EllipseMapSettings& settings)
    : log_basic_radius_(std::log(settings.basic_radius_mm)), effect_radius_mm_(settings.effect_radius_mm) {
  if (!(settings.basic_radius_mm > 0.0) || !std::isfinite(settings.basic_radius_mm)) {
    throw Error("contour map: the basic radius must be above 0 mm");
  }
  std::copy_if(points.begin(), points.end(), std::back_inserter(points_),
               [](const auto& p) { return p.contour.count; });
  if (!points_.empty()) radii_ = points_.front().contour.count;
  const auto fits = [&](const ContourPoint& point) { return point.contour.count == radii_; };
  if (!std::all_of(points_.begin(), points_.end(), fits)) {
    throw Error("contour map: every contour needs the same number of radii");
  }
}

PolarContour PolarContourMap::at(double x_mm, double y_mm) const noexcept {
  GaussianBlend<LogRadii> blend(LogRadii::Constant(log_basic_radius_));
  for (const ContourPoint& point : points_) {
    const double level = effectLevel((Vec2(x_mm, y_mm) - point.position_mm).norm(), effect_radius_mm_);
    if (level > 0.0) blend.add(level, Eigen::Map<const LogRadii>(point.contour.log_radii.data()));
  }
  PolarContour contour;
  contour.count = radii_;
  Eigen::Map<LogRadii>(contour.log_radii.data()) = blend.result();
  return contour;
}

SurfaceContour PolarContourMap::on(const Vec3& point, const Vec3& normal) const noexcept {
  return contourOnSurface(at(point.x(), point.y()), normal);
}

}  // namespace palpate::maps
