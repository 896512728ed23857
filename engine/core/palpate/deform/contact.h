// One finger on the skin, as the deformation needs it.
//
// `contact` produces a FingerOutput a tick; finger_contact.h turns it into this. Everything is plain data in millimetre
// and the body frame. Inputs are capped here and framed in frame.h.
// Based on: Ji, dissertation 2008, (4.4) to (4.6) and (4.15) to (4.18), with E19 and E21.
#pragma once

#include <optional>

#include "palpate/base/vec.h"
#include "palpate/deform/layered_frame.h"
#include "palpate/maps/polar_contour.h"

namespace palpate::deform {

struct Contact {
  Vec3 anchor = Vec3::Zero();        ///< friction anchor A on the undeformed skin: the centre of the deformation
  Index anchor_triangle = kNoIndex;  ///< the triangle A lies on: where the search for the region starts
  Vec3 normal = Vec3::UnitZ();       ///< outward normal of the contact; its length does not matter
  double depth_mm = 0.0;             ///< depth of the tip under the skin, along the normal; <= 0 presses nothing
  Vec3 drag_mm = Vec3::Zero();       ///< P - A: where the finger has pulled the skin, before f_adj and the cap
  /// Zero contours of the two parts (E21). Axes that are not in the tangent plane are turned into it.
  maps::SurfaceEllipse normal_region;
  maps::SurfaceEllipse tangential_region;
  /// Irregular boundary in place of the tangential ellipse, for Shape::contour only (forms.h); empty otherwise.
  maps::SurfaceContour tangential_contour;
  /// The tissue's own curves for this place and depth, in place of the profiles of the forms; the regions above end
  /// where these end.
  std::optional<LayeredShape> layered = {};
};

/// Limits of what skin on a back does, and how far a press reaches.
struct TissueSettings {
  double normal_cap_mm = 10.0;      ///< (4.15): the largest displacement along the normal
  double tangential_cap_mm = 20.0;  ///< (4.17): the largest displacement along the skin
  double f_adj = 1.0;               ///< (4.6): 1.3 for loose skin, 0.7 for tight skin
  /// Radius of the normal region R = R0 + c depth (E21), depth after the cap. The values fit a finite element model of
  /// a mid back (2 mm skin, 8 mm fat, 30 mm muscle) pressed 2 to 10 mm by a fingertip
  /// (docs/explanation/deformation.md).
  double normal_radius_mm = 13.2;
  double normal_radius_per_depth = 1.22;
};

/// (4.16): the depth within [0, cap]; 0 for a negative or undefined one (E19).
double cappedDepth(double depth_mm, double cap_mm) noexcept;

/// (4.18) as it must have read: the vector, shortened to the cap where it is longer (E19: its length, not its
/// components).
Vec3 cappedLength(const Vec3& displacement_mm, double cap_mm) noexcept;

// The caps as the damaged text can be read (E19): each component for itself, and a negative depth let through. A cap on
// the components turns a long drag towards a diagonal of the body's axes and lets it reach sqrt(3) times the cap.
double literallyCappedDepth(double depth_mm, double cap_mm) noexcept;
Vec3 literallyCappedDrag(const Vec3& drag_mm, double cap_mm) noexcept;
/// Largest length of the latter.
inline double literalDragReach(double cap_mm) noexcept { return 1.7320508075688772 * cap_mm; }

/// The circular region of the normal part at this depth (E21).
maps::SurfaceEllipse normalRegion(const Vec3& normal, double depth_mm, const TissueSettings& settings) noexcept;

}  // namespace palpate::deform
