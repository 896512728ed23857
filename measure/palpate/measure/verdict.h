// Whether a measurement can be used: what speaks against it, and what to do.
#pragma once

#include <vector>

#include "palpate/measure/measurement.h"

namespace palpate::measure {

/// Fewer dots in order give no chart worth a fit.
inline constexpr std::size_t kLeastDotsInOrder = 30;
/// More marks than this are no dots of a stencil.
inline constexpr std::size_t kMostMarks = 1500;

/// What of the grid forbids to go on, if anything.
std::vector<Finding> judgeGrid(const DotGrid& grid, const MeasureSettings& settings, const char* which = "first");

/// Of everything else. `newly_visible`: sites that only the second picture shows.
std::vector<Finding> judgeFit(const Measurement& measurement, std::size_t newly_visible);

}  // namespace palpate::measure
