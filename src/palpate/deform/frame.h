// A contact made ready: checked, capped, with the axes of its ellipses turned into its tangent plane.
//
// First step of Deformer::apply. Works in double; `lanes` hands the same numbers to the kernels in float.
#pragma once

#include "palpate/deform/contact.h"
#include "palpate/deform/kernels.h"

namespace palpate::deform {

/// The normal or the tangential part of a contact.
struct PartFrame {
  Vec3 along = Vec3::Zero();   ///< unit major axis / half major, 1/mm
  Vec3 across = Vec3::Zero();  ///< unit minor axis / half minor, 1/mm
  bool acts = false;           ///< has something to move and an ellipse to move it in
  /// Location ratio of a point seen along the contact's normal (E14).
  double ratioAt(const Vec3& offset) const { return std::hypot(along.dot(offset), across.dot(offset)); }
};

struct ContactFrame {
  Vec3 anchor = Vec3::Zero();
  Vec3 normal = Vec3::Zero();  ///< of unit length
  Index anchor_triangle = kNoIndex;
  double depth_mm = 0.0;        ///< wanted at the anchor, capped, >= 0
  Vec3 drag_mm = Vec3::Zero();  ///< wanted at the anchor, adjusted and capped
  PartFrame normal_part;
  PartFrame tangential_part;
};

/// The ellipse turned into the tangent plane of a unit normal; does not act where it is degenerate.
PartFrame partFrameOf(const maps::SurfaceEllipse& ellipse, const Vec3& unit_normal) noexcept;

/// True if every number of the contact is finite and its normal has a direction.
bool isUsable(const Contact& contact) noexcept;

/// The contact must be usable. A part without displacement or with a degenerate ellipse (no length, aspect not in
/// (0, 1], axis along the normal) does not act.
ContactFrame frameOf(const Contact& contact, const TissueSettings& settings) noexcept;

/// The frame as the kernels take it; `amplitude_mm` and `shift_mm` are what its centre moves by.
ContactLanes lanesOf(const ContactFrame& frame, double amplitude_mm, const Vec3& shift_mm) noexcept;

}  // namespace palpate::deform
