// The report of a fitted field: ellipses at two levels, contact, peak, drag, each with its standard deviation; the
// contour, and the verdict.
#pragma once

#include <span>
#include <vector>

#include "palpate/measure/field/field_fit.h"
#include "palpate/measure/measurement.h"
#include "palpate/measure/skin_chart.h"

namespace palpate::measure {

/// Half axes and direction of the ellipse through the places that move by `level_mm`; half axes 0 where nothing does.
struct LevelEllipse {
  double half_major_mm = 0.0;
  double half_minor_mm = 0.0;
  double direction_rad = 0.0;  ///< major axis, in (-pi/2, pi/2]
};
LevelEllipse levelEllipse(const SkinField& field, double level_mm, int rays = 72);

/// Reports the fitted forms, likeliest first; axes, contact and peak are means by their shares. Standard deviations by
/// draws from the covariances, the same draws every time: they include the difference of the forms. `mean_to_skin`:
/// from the picture's mm to the skin's in the middle of the dots, for the drift. Leaves residual_rms_mm and
/// inside_share alone.
FieldFit reportField(std::span<const WeighedField> forms, const Mat2& mean_to_skin, const DriftPrior& prior);

/// Widens for the unseen: no peak where no dot is in the core, a wider one where the best moved by much less, and wider
/// half axes where few dots are within the ellipse. `data` and `numbers` are the likeliest form's.
void widenByDots(std::span<const FieldDatum> data, const FieldNumbers& numbers, FieldFit& fit);

// The measurement as the dissertation made it: the field between the dots interpolated, its contour traced.

/// From dots with `after_px`; the fitted drift is taken off first. Rays go out from the fitted contact. None where too
/// little of the contour lies within the dots.
std::optional<ContourReading> readContour(std::span<const MeasuredDot> dots, const SkinChart& chart,
                                          const FieldFit& fit, double spacing_mm);

// Whether a measurement can be used: objections and remedies.

/// Fewer dots in order give no chart worth a fit.
inline constexpr std::size_t kMinDotsInOrder = 30;
/// More marks cannot be dots of a stencil.
inline constexpr std::size_t kMaxMarks = 1500;

/// Findings about the grid that rule out a measurement.
std::vector<Finding> judgeGrid(const DotGrid& grid, const MeasureSettings& settings, const char* which = "first");

/// Findings about the rest. `newly_visible`: sites that only the second picture shows.
std::vector<Finding> judgeFit(const Measurement& measurement, std::size_t newly_visible);

}  // namespace palpate::measure
