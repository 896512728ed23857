// Canonical form, location ratio (E14), the lift from the map to the skin (E32) and the logarithm by which ellipses
// blend.
//
// Based on: Ji, dissertation 2008, section 4.4 and (5.3); Arsigny, Fillard, Pennec, Ayache (2006), see ellipse.h.
#include "palpate/maps/ellipse.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "palpate/base/elementary.h"

namespace palpate::maps {

namespace {

constexpr double kPi = std::numbers::pi;
/// Half of ln(a/b) below which an ellipse counts as a circle: a difference of 1e-12 of its size has no direction.
constexpr double kCircle = 1e-12;
/// Sine below which a vector counts as parallel to a plane or axis; rounding alone makes 1e-16.
constexpr double kParallel = 1e-9;

double axisAngle(double angle_rad) {
  const double folded = std::fmod(angle_rad, kPi);
  const double positive = folded < 0.0 ? folded + kPi : folded;
  return positive < kPi ? positive : 0.0;  // a tiny negative angle rounds up to pi itself
}

/// The map axis seen along z on the tangent plane, not of unit length (5.3).
Vec3 alongZ(const Vec2& axis, const Vec3& n) {
  return {axis.x(), axis.y(), -(n.x() * axis.x() + n.y() * axis.y()) / n.z()};
}

/// For a vertical tangent plane: the map axis projected at right angles, or the axis across where it has no shadow.
Vec3 acrossPlane(const Vec2& axis, const Vec3& n) {
  const Vec3 along(axis.x(), axis.y(), 0.0);
  Vec3 shadow = along - along.dot(n) * n;
  if (shadow.norm() > kParallel) return shadow;
  return Vec3(-axis.y(), axis.x(), 0.0).cross(n);
}

}  // namespace

Ellipse canonicalEllipse(double half_along_mm, double half_across_mm, double direction_rad) {
  if (half_along_mm >= half_across_mm) return {half_along_mm, half_across_mm / half_along_mm, axisAngle(direction_rad)};
  return {half_across_mm, half_along_mm / half_across_mm, axisAngle(direction_rad + kPi / 2)};
}

Ellipse ellipseFromFullAxesCm(double along_cm, double across_cm, double direction_deg) {
  constexpr double kHalfMmPerCm = 5.0;
  return canonicalEllipse(along_cm * kHalfMmPerCm, across_cm * kHalfMmPerCm, direction_deg * kPi / 180.0);
}

double locationRatio(const Ellipse& ellipse, const Vec2& offset) {
  const Vec2 axis(elementary::cos(ellipse.direction_rad), elementary::sin(ellipse.direction_rad));
  const double length = ellipse.half_major_mm;
  return locationRatio(SurfaceEllipse{Vec3(axis.x() * length, axis.y() * length, 0.0), ellipse.aspect},
                       Vec3(offset.x(), offset.y(), 0.0));
}

LogTensor logTensor(const Ellipse& ellipse) {
  const double log_major = elementary::log(ellipse.half_major_mm);
  const double half_difference = -0.5 * elementary::log(ellipse.aspect);
  const double twice = 2.0 * ellipse.direction_rad;
  return {log_major - half_difference, half_difference * elementary::cos(twice),
          half_difference * elementary::sin(twice)};
}

Ellipse ellipseOf(const LogTensor& tensor) {
  const double half_difference = elementary::hypot(tensor.y(), tensor.z());
  if (half_difference < kCircle) return {elementary::exp(tensor.x()), 1.0};
  return {elementary::exp(tensor.x() + half_difference), elementary::exp(-2.0 * half_difference),
          axisAngle(0.5 * elementary::atan2(tensor.z(), tensor.y()))};
}

Vec3 projectedOnPlane(const Vec3& point, const Vec3& origin, const Vec3& unit_normal) {
  return point + unit_normal.dot(origin - point) * unit_normal;
}

double locationRatio(const SurfaceEllipse& ellipse, const Vec3& offset_in_plane) {
  const double length = ellipse.half_major.norm();
  if (!(length > 0.0)) return offset_in_plane.isZero(0.0) ? 0.0 : std::numeric_limits<double>::infinity();
  const Vec3 axis = ellipse.half_major / length;
  const double along = offset_in_plane.dot(axis);
  const double across = (offset_in_plane - along * axis).norm();
  return elementary::hypot(along, across / ellipse.aspect) / length;
}

SurfaceEllipse liftedOntoSurface(const Ellipse& ellipse, const Vec3& normal) {
  const double length = normal.norm();
  if (!(length > 0.0) || !std::isfinite(length)) return {};
  const Vec3 n = normal / length;
  const Vec2 axis(elementary::cos(ellipse.direction_rad), elementary::sin(ellipse.direction_rad));
  const Vec3 lifted = std::abs(n.z()) > kParallel ? alongZ(axis, n) : acrossPlane(axis, n);
  return {lifted.normalized() * ellipse.half_major_mm, ellipse.aspect};
}

}  // namespace palpate::maps
