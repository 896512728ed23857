// The displacement of dragged skin as a form with fifteen numbers, and what of it is reported.
//
//   SkinField ─ displacementAt ─► mm    fitted by field_fit.h; drawn by overlays
//
// Frame of the skin: a chart flat along the skin, x to the right as seen in the picture, y towards the head, mm.
#pragma once

#include <optional>

#include "palpate/base/vec.h"
#include "palpate/maps/ellipse.h"

namespace palpate::measure {

/// How the motion falls off from the contact (field_form.h).
enum class FieldForm : unsigned char {
  smooth,   ///< half Gaussian to long tail
  pointed,  ///< exponential to 1/rho
  deep,     ///< elastic half space
  solved    ///< layers over bone, by finite elements
};

/// Smooth: u(x) = peak (1 + rho^2 / P)^-P + drift, rho^2 = (x - contact)' W (x - contact), ln W = the three numbers of
/// log_shape; and with kappa: peak becomes peak + kappa rho^2 / (1 + rho^2) (e . peak) e, e = (x - contact) / |x -
/// contact|.
struct SkinField {
  Vec2 contact_mm = Vec2::Zero();
  Vec3 log_shape = Vec3::Zero();  ///< xx, xy, yy of the logarithm of W; W in 1/mm^2
  Vec2 peak_mm = Vec2::Zero();
  double inverse_tail = 0.0;    ///< k = 1/P; 0 is the half Gaussian, 2 the longest tail
  double sideways = 0.0;        ///< kappa
  Vec2 pressed = Vec2::Zero();  ///< outwards all around (pressShapeAt), shares of the peak
  FieldForm form = FieldForm::smooth;
};

/// Without drift, mm.
Vec2 displacementAt(const SkinField& field, const Vec2& place_mm);

struct Estimate {
  double value = 0.0;
  double sd = 0.0;
};

/// The ellipse through the places that move by `level_mm`.
struct KeyEllipse {
  double level_mm = 2.0;
  Estimate half_major_mm;
  Estimate half_minor_mm;
  Estimate major_over_minor;
  Estimate direction_deg;  ///< major axis against +x, in (-90, 90]
};

inline maps::Ellipse ellipseOf(const KeyEllipse& key) {
  return maps::canonicalEllipse(key.half_major_mm.value, key.half_minor_mm.value,
                                key.direction_deg.value * 3.14159265358979323846 / 180.0);
}

}  // namespace palpate::measure
