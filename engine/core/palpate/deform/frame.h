// A contact made ready: checked, capped, with the regions of its two parts turned into its tangent plane.
//
// First step of an apply. Both displacements work on framed contacts; what a region is differs: a plain ellipse here,
// any shape in region_frame.h. In double. Based on: Ji, dissertation 2008, sections 4.3 and 4.4, with E14 and E32.
#pragma once

#include <algorithm>
#include <cmath>

#include "palpate/base/elementary.h"
#include "palpate/deform/contact.h"
#include "palpate/deform/layered_frame.h"

namespace palpate::deform {

template <class Region>
struct FramedContact {
  Vec3 anchor = Vec3::Zero();
  Vec3 normal = Vec3::Zero();  ///< unit length
  Index anchor_triangle = kNoIndex;
  double depth_mm = 0.0;        ///< wanted at the anchor, capped; below 0 only as printed (E19)
  Vec3 drag_mm = Vec3::Zero();  ///< wanted at the anchor, adjusted and capped
  Region press;                 ///< acts if there is something to press and an area to press it in
  Region drag;                  ///< likewise
  std::optional<LayeredFrame> layered = {};

  FramedContact() = default;
  /// The place alone; depth and region are set later.
  explicit FramedContact(const Contact& contact)
      : anchor(contact.anchor), normal(contact.normal.normalized()), anchor_triangle(contact.anchor_triangle) {
    if (contact.layered) layered.emplace(*contact.layered);
  }
  bool wantsPress() const { return depth_mm != 0.0; }
  bool wantsDrag() const { return !drag_mm.isZero(0.0); }
};

// Height over the tangent plane that does not count, mm. A point farther off it is at least that far along the skin as
// through the air, and a finger does not take it along.
/// For layered tissue: shoulders and hips turn away from a back by more within a finger's reach.
inline constexpr double kLayeredLevelMm = 30.0;
/// For the half Gaussian, whose measured ellipses lie in a plane: all of a back, which is 120 mm deep.
inline constexpr double kFlatLevelMm = 130.0;

inline double levelOf(const Contact& contact) noexcept { return contact.layered ? kLayeredLevelMm : kFlatLevelMm; }

/// Reach of a region above and below the tangent plane: within `level_mm` as seen along the normal, then the location
/// ratio grows as in an ellipsoid, and nothing moves from `level_mm + fall_mm` on.
struct Rise {
  Vec3 normal = Vec3::Zero();  ///< unit
  double level_mm = 0.0;       ///< infinite where the normal does not bound (as printed, E23)
  double fall_mm = 1.0;

  /// Rise of an offset from the anchor; 0 up to level_mm either way, 1 at level_mm + fall_mm.
  double at(const Vec3& offset) const noexcept {
    const double beyond = std::abs(normal.dot(offset)) - level_mm;
    return beyond > 0.0 ? beyond / fall_mm : 0.0;
  }
};

/// Rise for a region with these radii. A region no longer than `level_mm` keeps all of a ball that faces the finger:
/// none of it lies lower than its own radius, nor than the axis that holds it. The ratio grows with height as across
/// the region: nowhere steeper than in the plane, which the bounds of the shear rely on.
inline Rise riseOf(const Vec3& unit_normal, double longest_mm, double shortest_mm, double level_mm) noexcept {
  return {unit_normal, std::min(longest_mm, level_mm), shortest_mm};
}

/// An ellipse in the tangent plane of its contact.
struct FlatEllipse {
  Vec3 along = Vec3::Zero();   ///< unit major axis / half major, 1/mm
  Vec3 across = Vec3::Zero();  ///< unit minor axis / half minor, 1/mm
  Rise rise;
  double half_major_mm = 0.0;
  bool has_area = false;

  bool acts() const { return has_area; }
  /// Location ratio of a point (E14).
  double ratioAt(const Vec3& offset) const {
    const double flat = elementary::hypot(along.dot(offset), across.dot(offset));
    const double up = rise.at(offset);
    return up > 0.0 ? elementary::hypot(flat, up) : flat;
  }
  /// The largest slope of the ratio, 1/mm.
  double steepest() const { return across.norm(); }
};

/// The ellipse turned into the tangent plane of a unit normal. Without area where it is degenerate: no length, aspect
/// not in (0, 1], axis along the normal.
FlatEllipse flatEllipse(const maps::SurfaceEllipse& ellipse, const Vec3& unit_normal, double level_mm) noexcept;

/// True if every number of the contact is finite and its normal has a direction.
bool isUsable(const Contact& contact) noexcept;

}  // namespace palpate::deform
