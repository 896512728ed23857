// Catmull-Rom through the logarithms of the radii round the contour, so that no radius can become negative.
//
// Based on: Catmull, Rom, "A class of local interpolating splines" (1974); Ji, dissertation 2008, section 6.2.
#include "palpate/maps/polar_contour.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "palpate/base/elementary.h"
#include "palpate/base/error.h"

namespace palpate::maps {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

void requireCount(std::size_t radii) {
  if (radii >= kMinContourRadii && radii <= kMaxContourRadii) return;
  throw Error(fmt::format("contour: {} radii; expected {} to {}", radii, kMinContourRadii, kMaxContourRadii));
}

/// From p1 at t = 0 to p2 at t = 1, with the slopes of the neighbours.
double catmullRom(double p0, double p1, double p2, double p3, double t) {
  const double slope1 = 0.5 * (p2 - p0);
  const double slope2 = 0.5 * (p3 - p1);
  const double rise = p2 - p1;
  return p1 + t * (slope1 + t * (3.0 * rise - 2.0 * slope1 - slope2 + t * (slope1 + slope2 - 2.0 * rise)));
}

/// The radius of an ellipse in a direction.
double polarRadius(const Ellipse& ellipse, double angle_rad) {
  return 1.0 / locationRatio(ellipse, Vec2(elementary::cos(angle_rad), elementary::sin(angle_rad)));
}

double radiusRatio(double distance, double radius) {
  if (distance == 0.0) return 0.0;
  return radius > 0.0 ? distance / radius : std::numeric_limits<double>::infinity();
}

}  // namespace

PolarContour contourOf(std::span<const double> radii_mm) {
  requireCount(radii_mm.size());
  PolarContour contour;
  contour.count = radii_mm.size();
  for (std::size_t i = 0; i < contour.count; ++i) {
    if (!(radii_mm[i] > 0.0) || !std::isfinite(radii_mm[i])) {
      throw Error(
          fmt::format("contour: radius {} of {} must be above 0 mm, got {}", i + 1, contour.count, radii_mm[i]));
    }
    contour.log_radii[i] = elementary::log(radii_mm[i]);
  }
  return contour;
}

PolarContour contourOf(const Ellipse& ellipse, std::size_t radii) {
  requireCount(radii);
  if (!(ellipse.half_major_mm > 0.0)) return {};
  PolarContour contour;
  contour.count = radii;
  for (std::size_t i = 0; i < radii; ++i) {
    contour.log_radii[i] =
        elementary::log(polarRadius(ellipse, kTurn * static_cast<double>(i) / static_cast<double>(radii)));
  }
  return contour;
}

double radiusAt(const PolarContour& contour, double angle_rad) noexcept {
  if (contour.count == 0 || !std::isfinite(angle_rad)) return 0.0;
  const double turns = angle_rad / kTurn;
  const double position = (turns - std::floor(turns)) * static_cast<double>(contour.count);
  const std::size_t before = std::min(static_cast<std::size_t>(position), contour.count - 1);
  const auto at = [&](std::size_t steps) {
    return contour.log_radii[(before + contour.count + steps - 1) % contour.count];
  };
  return elementary::exp(catmullRom(at(0), at(1), at(2), at(3), position - static_cast<double>(before)));
}

double locationRatio(const PolarContour& contour, const Vec2& offset) noexcept {
  return radiusRatio(offset.norm(), radiusAt(contour, elementary::atan2(offset.y(), offset.x())));
}

SurfaceContour contourOnSurface(const PolarContour& contour, const Vec3& normal) noexcept {
  constexpr Ellipse kAlongX{1.0, 1.0, 0.0};
  const Vec3 axis_x = liftedOntoSurface(kAlongX, normal).half_major;
  if (axis_x.isZero(0.0)) return {};
  // On the far side of a body the map is still seen along z, hence through the skin.
  const double facing = normal.z() < 0.0 ? -1.0 : 1.0;
  return {contour, axis_x, facing * normal.normalized().cross(axis_x)};
}

double locationRatio(const SurfaceContour& contour, const Vec3& offset_in_plane) noexcept {
  const double angle = elementary::atan2(offset_in_plane.dot(contour.axis_y), offset_in_plane.dot(contour.axis_x));
  return radiusRatio(offset_in_plane.norm(), radiusAt(contour.contour, angle));
}

}  // namespace palpate::maps
