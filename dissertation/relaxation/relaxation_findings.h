// What a measurement of skin that relaxes says, in sentences whose verdicts its numbers decide.
#pragma once

#include <string>
#include <vector>

#include "dissertation/relaxation/relaxation_measurement.h"

namespace palpate::study {

/// Of the force at once, what is lost after so many seconds of holding; of the time of heldTimes() nearest to it.
double lostAfter(const RelaxingSkin& skin, double seconds);

std::vector<std::string> relaxationFindings(const RelaxationMeasurement& found);

}  // namespace palpate::study
