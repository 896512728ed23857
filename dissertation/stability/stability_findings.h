// What the measurement of stability says, in sentences and numbers; decided by the numbers alone.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "dissertation/stability/stability_measurement.h"

namespace palpate::study {

/// The worst of all rows, in the units of the JSON keys.
struct StabilityNumbers {
  double theory_error_percent = 0.0;
  double first_contact_force_n = 0.0;  ///< controlled, at most 3 N/mm, at 0.5 m/s
  double port_energy_mj = 0.0;
  double stiffness_bias_percent = 0.0;  ///< at most 1 N/mm
};

StabilityNumbers numbersOf(const StabilityMeasurement& found);

/// Share of the random systems of this cell that oscillate; NaN where it was not measured.
double oscillatingShare(const StabilityMeasurement& found, const lab::RandomCell& cell);

std::vector<std::string> stabilityFindings(const StabilityMeasurement& found);

/// By the names that programs know.
std::vector<std::pair<std::string, double>> stabilityPairs(const StabilityMeasurement& found);

}  // namespace palpate::study
