// What is reported of a fitted field: ellipses at two levels, contact, peak, drag, each with its standard deviation.
#pragma once

#include <span>

#include "palpate/measure/field/field_fit.h"
#include "palpate/measure/measurement.h"

namespace palpate::measure {

/// Half axes and direction of the ellipse through the places that move by `level_mm`; half axes 0 where nothing does.
struct LevelEllipse {
  double half_major_mm = 0.0;
  double half_minor_mm = 0.0;
  double direction_rad = 0.0;  ///< of the major axis, in (-pi/2, pi/2]
};
LevelEllipse levelEllipse(const SkinField& field, double level_mm, int rays = 72);

/// Of the forms that were fitted, likeliest first; axes, contact and peak are means by their shares. Standard
/// deviations by draws from the covariances, the same draws every time: what the forms differ by is in them.
/// `mean_to_skin`: from the picture's mm to the skin's in the middle of the dots, for the drift. Leaves residual_rms_mm
/// and inside_share alone.
FieldFit reportField(std::span<const WeighedField> forms, const Mat2& mean_to_skin, const DriftPrior& prior);

/// What the dots could not see: no peak where none lies in the core, a wider one where the best moved by much less, and
/// wider half axes where few dots lie within the ellipse. `data` and `numbers`: of the likeliest form.
void widenByDots(std::span<const FieldDatum> data, const FieldNumbers& numbers, FieldFit& fit);

}  // namespace palpate::measure
