// What a measurement of synthetic pairs says, in sentences whose verdicts its numbers decide.
#pragma once

#include <string>
#include <vector>

#include "measure/study/measuring_measurement.h"

namespace palpate::study {

std::vector<std::string> measuringFindings(const MeasuringMeasurement& found);

}  // namespace palpate::study
