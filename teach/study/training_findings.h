// What tests of simulated trainees say, in sentences whose verdicts their numbers decide.
#pragma once

#include <string>
#include <vector>

#include "teach/study/training_measurement.h"

namespace palpate::study {

std::vector<std::string> trainingFindings(const TrainingMeasurement& found);

}  // namespace palpate::study
