// The measurement as the dissertation made it: the field between the dots interpolated, its contour traced.
#pragma once

#include <span>

#include "palpate/measure/measurement.h"
#include "palpate/measure/skin_chart.h"

namespace palpate::measure {

/// From dots with `after_px`; the fitted drift is taken off first. Rays go out from the fitted contact. None where too
/// little of the contour lies within the dots.
std::optional<ContourReading> readContour(std::span<const MeasuredDot> dots, const SkinChart& chart,
                                          const FieldFit& fit, double spacing_mm);

}  // namespace palpate::measure
