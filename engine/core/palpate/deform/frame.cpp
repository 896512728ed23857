// The major axis loses its part along the normal, then gets its own length back: a tilted ellipse does not shrink, by
// the rule of E32. Axes are kept as directions over lengths, so that a location ratio is one hypot (E14).
// Data flow: contacts of a frame -> here -> framed contacts -> regions and displacement. 60 times a second.
// Based on: Ji, dissertation 2008, sections 4.3 and 4.4, with E14 and E32.
#include "palpate/deform/frame.h"

#include <cmath>

namespace palpate::deform {

namespace {

/// Smallest half axis that counts, mm: a hundredth of the finest triangle's edge. Keeps 1 / axis a normal float.
constexpr double kSmallestAxis = 1e-6;
/// Sine below which an axis counts as parallel to the normal.
constexpr double kParallel = 1e-6;

bool isFinite(const maps::SurfaceEllipse& e) noexcept { return e.half_major.allFinite() && std::isfinite(e.aspect); }

}  // namespace

FlatEllipse flatEllipse(const maps::SurfaceEllipse& ellipse, const Vec3& unit_normal, double level_mm) noexcept {
  const double length = ellipse.half_major.norm();
  const Vec3 in_plane = ellipse.half_major - ellipse.half_major.dot(unit_normal) * unit_normal;
  const bool is_flat = in_plane.norm() > kParallel * length;
  const bool has_size = ellipse.aspect > 0.0 && ellipse.aspect <= 1.0 && length * ellipse.aspect > kSmallestAxis;
  if (!is_flat || !has_size) return {};
  const Vec3 axis = in_plane.normalized();
  const double minor = length * ellipse.aspect;
  const Rise rise = riseOf(unit_normal, length, minor, level_mm);
  return {axis / length, unit_normal.cross(axis) / minor, rise, length, true};
}

bool isUsable(const Contact& contact) noexcept {
  return contact.anchor.allFinite() && contact.normal.allFinite() && contact.normal.norm() > 0.0 &&
         std::isfinite(contact.depth_mm) && contact.drag_mm.allFinite() && isFinite(contact.normal_region) &&
         isFinite(contact.tangential_region);
}

}  // namespace palpate::deform
