// Findings from the left-out points and the maps about interpolations: the results, and sentences made of nothing but
// them.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "dissertation/interpolation/left_out.h"
#include "palpate/maps/measured_data.h"
#include "report/charts/figure.h"

namespace palpate::study {

// The pictures of the interpolation study: surfaces of Table 5.1, maps of the back.

/// Figures 5.9 and 5.10 as surfaces, for three effect radii each. `cells` along a side.
figures::Figure widthSurfaces(int cells);
/// Sections along the y axis of (5.7) and (5.16) with the printed values, and (5.7) at the keys over the effect radius.
figures::Figure widthSections();
/// Figure 5.11 for three effect radii. `step_mm` between two values.
figures::Figure backOverWidths(double step_mm);
/// The half major axis over the back by GRI, thin plate and plane.
figures::Figure interpolatorMapFigure(double step_mm);
/// Maps of ellipses dragged up and down, and their differences.
figures::Figure upAndDown(double step_mm);

/// The effect radii between which (5.7) gives both numbers of Figure 5.9 to the printed digit, mm.
struct RadiusRange {
  double from = 0.0;
  double to = 0.0;
};
RadiusRange radiiOfFigure59();

inline constexpr double kEffectRadius = 200.0;  ///< the engine's (E28)
inline constexpr double kBasicCircle = 150.0;   ///< the engine's, mm (E33)
inline constexpr std::array<const char*, kInterpolators.size()> kInterpolatorNames{
    "mean of the others", "GRI over 150 mm (engine)", "GRI over the mean",
    "thin plate",         "polynomial, degree 1",     "polynomial, degree 2"};

using InterpolatorErrors = std::array<LeftOutErrors, kInterpolators.size()>;

struct InterpolationResults {
  InterpolatorErrors means;     ///< the two sets of means: up and down
  InterpolatorErrors subjects;  ///< every subject by itself
  double scatter_mm = 0;        ///< between subjects at the same point
  std::vector<double> radii;
  std::vector<double> subject_error_mm;  ///< error of GRI over 150 mm, one a radius
  std::vector<double> mean_base_error_mm;
  RadiusRange figure_5_9;
  double furthest_from_key_mm = 0.0;                                      ///< (5.16) at the keys of Table 5.1
  std::pair<double, double> measured_mm;                                  ///< half major axes of keys and basic circle
  std::array<std::pair<double, double>, kInterpolators.size()> range_mm;  ///< half major axis over the back
  double up_down_mm = 0.0;                                                ///< rms of the boundary over the back
  double up_down_most_mm = 0.0;
  double expected_up_down_mm = 0.0;  ///< by chance alone
};

/// The effect radius with the smallest error.
double bestRadius(const InterpolationResults& results);

/// Paragraphs, most important first.
std::vector<std::string> interpolationFindings(const InterpolationResults& results);

}  // namespace palpate::study
