// What the left-out points and the maps say of interpolations: the results, and sentences made of nothing but them.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "dissertation/interpolation/interpolation_figures.h"
#include "dissertation/interpolation/left_out.h"

namespace palpate::study {

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
  std::vector<double> subject_error_mm;  ///< of GRI over 150 mm, one a radius
  std::vector<double> mean_base_error_mm;
  RadiusRange figure_5_9;
  double furthest_from_key_mm = 0.0;                                      ///< (5.16) at the keys of Table 5.1
  std::pair<double, double> measured_mm;                                  ///< half major axes of keys and basic circle
  std::array<std::pair<double, double>, kInterpolators.size()> range_mm;  ///< of the half major axis over the back
  double up_down_mm = 0.0;                                                ///< rms of the boundary over the back
  double up_down_most_mm = 0.0;
  double expected_up_down_mm = 0.0;  ///< that chance alone would make of it
};

/// The effect radius with the smallest error.
double bestRadius(const InterpolationResults& results);

/// A paragraph each, most important first.
std::vector<std::string> interpolationFindings(const InterpolationResults& results);

}  // namespace palpate::study
