#include "palpate/deform/frame.h"

#include <cmath>

namespace palpate::deform {

namespace {

/// Smallest half axis that counts, mm: a hundredth of the finest triangle's edge. Keeps 1 / axis a normal float.
constexpr double kSmallestAxis = 1e-6;
/// Sine below which an axis counts as parallel to the normal.
constexpr double kParallel = 1e-6;

bool isFinite(const maps::SurfaceEllipse& e) noexcept { return e.half_major.allFinite() && std::isfinite(e.aspect); }

PartFrame partOf(const maps::SurfaceEllipse& ellipse, const Vec3& normal, bool moves) noexcept {
  return moves ? partFrameOf(ellipse, normal) : PartFrame{};
}

void copyTo(float (&out)[3], const Vec3& v) noexcept {
  for (int i = 0; i < 3; ++i) out[i] = static_cast<float>(v[i]);
}

PartLanes lanesOf(const PartFrame& part, const Vec3& shift_mm) noexcept {
  PartLanes lanes;
  if (!part.acts) return lanes;
  copyTo(lanes.along, part.along);
  copyTo(lanes.across, part.across);
  copyTo(lanes.shift, shift_mm);
  lanes.outside = 0.0f;
  return lanes;
}

}  // namespace

PartFrame partFrameOf(const maps::SurfaceEllipse& ellipse, const Vec3& unit_normal) noexcept {
  const double length = ellipse.half_major.norm();
  const Vec3 in_plane = ellipse.half_major - ellipse.half_major.dot(unit_normal) * unit_normal;
  const bool is_flat = in_plane.norm() > kParallel * length;
  const bool has_size = ellipse.aspect > 0.0 && ellipse.aspect <= 1.0 && length * ellipse.aspect > kSmallestAxis;
  if (!is_flat || !has_size) return {};
  const Vec3 axis = in_plane.normalized();
  return {axis / length, unit_normal.cross(axis) / (length * ellipse.aspect), true};
}

bool isUsable(const Contact& contact) noexcept {
  return contact.anchor.allFinite() && contact.normal.allFinite() && contact.normal.norm() > 0.0 &&
         std::isfinite(contact.depth_mm) && contact.drag_mm.allFinite() && isFinite(contact.normal_region) &&
         isFinite(contact.tangential_region);
}

ContactFrame frameOf(const Contact& contact, const TissueSettings& settings) noexcept {
  ContactFrame frame;
  frame.anchor = contact.anchor;
  frame.normal = contact.normal.normalized();
  frame.anchor_triangle = contact.anchor_triangle;
  frame.depth_mm = cappedDepth(contact.depth_mm, settings.normal_cap_mm);
  frame.drag_mm = cappedLength(settings.f_adj * contact.drag_mm, settings.tangential_cap_mm);
  frame.normal_part = partOf(contact.normal_region, frame.normal, frame.depth_mm > 0.0);
  frame.tangential_part = partOf(contact.tangential_region, frame.normal, !frame.drag_mm.isZero(0.0));
  return frame;
}

ContactLanes lanesOf(const ContactFrame& frame, double amplitude_mm, const Vec3& shift_mm) noexcept {
  ContactLanes lanes;
  copyTo(lanes.anchor, frame.anchor);
  copyTo(lanes.facing, frame.normal);
  lanes.normal = lanesOf(frame.normal_part, -amplitude_mm * frame.normal);
  lanes.tangential = lanesOf(frame.tangential_part, shift_mm);
  return lanes;
}

}  // namespace palpate::deform
