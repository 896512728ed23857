// The cut through the skin at a finger: the curve at rest and the same skin deformed, in mm (Fig 4.7).
//
// The plane contains the contact's normal and the direction of the drag (across the body without one), so that both
// press and pull are in it. The curve is the cut of the skin at rest; its points then follow the deformation. No GL
// except in drawSection (section_inset.cpp).
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "palpate/contact/finger_state.h"
#include "palpate/deform/surface.h"
#include "palpate/scene/world.h"
#include "palpate/view/finger_pose.h"

namespace palpate::view {

class Drawing;
struct LabelInks;

/// The finger of the cut: the one that presses deepest, without contacts the first; null without fingers.
const FingerMark* sectionFinger(std::span<const FingerMark> fingers);

struct SectionPlane {
  Vec3 origin = Vec3::Zero();   ///< the friction anchor
  Vec3 along = Vec3::UnitX();   ///< unit
  Vec3 upward = Vec3::UnitZ();  ///< unit, square to `along`: out of the skin
};

/// The plane of a finger; for one in free space, at the skin below it.
SectionPlane sectionPlane(const scene::World& world, const contact::FingerOutput& contact);

/// First coordinate along the plane, second upward, mm from its origin.
struct SectionPoint {
  Vec2 rest;
  Vec2 deformed;
};

/// The skin connected to the origin, up to `half_width_mm` to either side, in the order of `along`. Round a closed body
/// that is narrower once, and its first point again. Empty where the plane does not meet the skin at its origin.
std::vector<SectionPoint> sectionCurve(const scene::World& world, const deform::DeformedSurface& surface,
                                       const SectionPlane& plane, double half_width_mm = 60.0);

/// The same with the deformed place of each vertex given.
std::vector<SectionPoint> sectionCurve(const scene::World& world, const std::function<Vec3(Index)>& deformed,
                                       const SectionPlane& plane, double half_width_mm = 60.0);

/// A section's point back in the body frame.
inline Vec3 onPlane(const SectionPlane& plane, const Vec2& point) {
  return plane.origin + point.x() * plane.along + point.y() * plane.upward;
}

/// The names of the two ends of a cut, in the picture and in the chart: letters, and the patient's side of an end where
/// there is one: "A left", "B right".
struct SectionEnds {
  std::string low, high;
};
SectionEnds sectionEnds(const SectionPlane& plane);

/// The section's chart: its place on the page, points, and its text.
struct SectionChart {
  Vec2f corner = Vec2f::Zero();  ///< upper left
  Vec2f size = {240.0f, 120.0f};
  SectionEnds ends = {};
  /// Largest drawn depth of the skin, when the finger is deeper than that, mm.
  std::optional<double> cap_mm = {};
};

/// Half width of the chart on either side of the contact, mm.
inline constexpr double kSectionHalfWidthMm = 40.0;

/// Draws it with both axes in mm. Heights are drawn larger than widths: the numbers at the axes show the ratio. Draws
/// nothing for an empty curve.
void drawSection(Drawing& page, std::span<const SectionPoint> curve, const SectionChart& chart, const LabelInks& inks);

}  // namespace palpate::view
