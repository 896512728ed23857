// Location ratio and slope in an ellipse, its printed form, and a contour.
//
// Data flow: a contact's ellipse or contour -> RegionFrame -> locate, for regions, coupling and displacement.
// Based on: Ji, dissertation 2008, section 4.4, (4.7) to (4.14), with E14 and E15.
#include "palpate/deform/region_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "palpate/base/elementary.h"
#include "palpate/deform/frame.h"

namespace palpate::deform {

namespace {

/// Step for the slope of a contour's radius, radian: the contour is a piecewise cubic of arcs of 0.1 and more, far
/// coarser, and its rounding is far finer.
constexpr double kAngleStep = 1e-5;

Location ellipseLocation(const RegionFrame& region, const Vec2& offset) noexcept {
  const Vec2 scaled(offset.x() / region.half_along_mm, offset.y() / region.half_across_mm);
  const double q = scaled.norm();  // E14
  if (!(q > 0.0)) return {};
  return {q, Vec2(scaled.x() / region.half_along_mm, scaled.y() / region.half_across_mm) / q};
}

/// q = d / rho(angle), hence grad q = e_radial / rho - (rho' / rho^2) e_turning.
Location contourLocation(const RegionFrame& region, const Vec2& offset) noexcept {
  const double distance = offset.norm();
  if (!(distance > 0.0)) return {};
  const double angle = elementary::atan2(offset.y(), offset.x());
  const double radius = maps::radiusAt(region.contour, angle);
  const double growth =
      (maps::radiusAt(region.contour, angle + kAngleStep) - maps::radiusAt(region.contour, angle - kAngleStep)) /
      (2.0 * kAngleStep);
  const Vec2 radial = offset / distance;
  const Vec2 turning(-radial.y(), radial.x());
  return {distance / radius, radial / radius - growth / (radius * radius) * turning};
}

Rise riseOfRegion(const RegionFrame& region, const Vec3& unit_normal, const FormSettings& forms,
                  double level_mm) noexcept {
  Rise rise = riseOf(unit_normal, longestRadius(region), shortestRadius(region), level_mm);
  if (forms.fidelity.literal(Erratum::E23_region_search)) rise.level_mm = std::numeric_limits<double>::infinity();
  return rise;
}

/// The smallest and the largest of a contour's radii.
std::pair<double, double> radiusRange(const maps::PolarContour& contour) noexcept {
  const auto end = contour.log_radii.begin() + static_cast<std::ptrdiff_t>(contour.count);
  const auto [least, most] = std::minmax_element(contour.log_radii.begin(), end);
  return {elementary::exp(*least), elementary::exp(*most)};
}

}  // namespace

RegionFrame ellipseFrame(const maps::SurfaceEllipse& ellipse, const Vec3& unit_normal, const FormSettings& forms,
                         double level_mm) noexcept {
  const FlatEllipse part = flatEllipse(ellipse, unit_normal, level_mm);
  if (!part.acts()) return {};
  RegionFrame frame;
  frame.kind =
      forms.fidelity.literal(Erratum::E14_location_ratio) ? RegionFrame::Kind::pedal : RegionFrame::Kind::ellipse;
  frame.along = part.along.normalized();
  frame.across = part.across.normalized();
  frame.half_along_mm = 1.0 / part.along.norm();
  frame.half_across_mm = 1.0 / part.across.norm();
  if (forms.fidelity.literal(Erratum::E15_aspect)) frame.half_across_mm = frame.half_along_mm / ellipse.aspect;
  if (forms.shape == Shape::circle) {
    frame.half_along_mm = frame.half_across_mm = std::sqrt(frame.half_along_mm * frame.half_across_mm);
  }
  frame.rise = riseOfRegion(frame, unit_normal, forms, level_mm);
  return frame;
}

RegionFrame contourFrame(const maps::SurfaceContour& contour, const Vec3& unit_normal, const FormSettings& forms,
                         double level_mm) noexcept {
  const Vec3 flat = contour.axis_x - contour.axis_x.dot(unit_normal) * unit_normal;
  if (contour.contour.count < maps::kMinContourRadii || !(flat.norm() > 1e-6)) return {};
  RegionFrame frame;
  frame.kind = RegionFrame::Kind::contour;
  frame.along = flat.normalized();
  const Vec3 across = unit_normal.cross(frame.along);
  frame.across = across.dot(contour.axis_y) < 0.0 ? Vec3(-across) : across;
  frame.contour = contour.contour;
  frame.rise = riseOfRegion(frame, unit_normal, forms, level_mm);
  return frame;
}

Location locate(const RegionFrame& region, const Vec2& offset) noexcept {
  switch (region.kind) {
    case RegionFrame::Kind::ellipse:
      return ellipseLocation(region, offset);
    case RegionFrame::Kind::pedal:
      return pedalLocation(region.half_along_mm, region.half_across_mm / region.half_along_mm, offset);
    case RegionFrame::Kind::contour:
      return contourLocation(region, offset);
    case RegionFrame::Kind::none:
      break;
  }
  return {2.0, Vec2::Zero()};
}

SpatialLocation locateInSpace(const RegionFrame& region, const Vec3& offset) noexcept {
  const Location flat = locate(region, inPlane(region, offset));
  const Vec3 slope = flat.slope.x() * region.along + flat.slope.y() * region.across;
  const double up = region.rise.at(offset);
  if (!(up > 0.0)) return {flat.q, slope};
  const double q = elementary::hypot(flat.q, up);
  const double up_slope = std::copysign(1.0 / region.rise.fall_mm, region.rise.normal.dot(offset));
  return {q, (flat.q * slope + up * up_slope * region.rise.normal) / q};
}

double longestRadius(const RegionFrame& region) noexcept {
  if (region.kind == RegionFrame::Kind::contour) return radiusRange(region.contour).second;
  return std::max(region.half_along_mm, region.half_across_mm);
}

double shortestRadius(const RegionFrame& region) noexcept {
  if (region.kind == RegionFrame::Kind::contour) return radiusRange(region.contour).first;
  return std::min(region.half_along_mm, region.half_across_mm);
}

}  // namespace palpate::deform
