// What was measured, in words and numbers with their standard deviations, line by line.
#pragma once

#include <string>
#include <vector>

#include "palpate/measure/measurement.h"

namespace palpate::viewer {

struct MeasuredNumber {
  std::string label;
  std::string value;
};
/// Empty without a fit.
std::vector<MeasuredNumber> measuredNumbers(const measure::Measurement& measured);

/// "71.3 ± 1.2 mm", with so many decimals.
std::string withSd(const measure::Estimate& estimate, int digits, const char* unit);

}  // namespace palpate::viewer
