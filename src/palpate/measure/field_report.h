// What is reported of a fitted field: ellipses at two levels, contact, peak, drag, each with its standard deviation.
#pragma once

#include "palpate/measure/field_fit.h"
#include "palpate/measure/measurement.h"

namespace palpate::measure {

/// Half axes and direction of the ellipse through the places that move by `level_mm`; half axes 0 where nothing does.
struct LevelEllipse {
  double half_major_mm = 0.0;
  double half_minor_mm = 0.0;
  double direction_rad = 0.0;  ///< of the major axis, in (-pi/2, pi/2]
};
LevelEllipse levelEllipse(const SkinField& field, double level_mm, int rays = 72);

/// Standard deviations by draws from the covariance, the same draws every time. `mean_to_skin`: from the picture's mm
/// to the skin's in the middle of the dots, for the drift. Leaves residual_rms_mm and inside_share alone.
FieldFit reportField(const FittedField& fitted, const Mat2& mean_to_skin, const DriftPrior& prior);

}  // namespace palpate::measure
