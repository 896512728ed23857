// What the frames say of the threshold: sentences made of nothing but the measurement.
#pragma once

#include <string>
#include <vector>

#include "dissertation/threshold/threshold_measurement.h"

namespace palpate::study {

/// A paragraph each, most important first.
std::vector<std::string> thresholdFindings(const ThresholdMeasurement& found);

/// The time of a frame at the printed threshold over that at the fastest, of one model and tree.
double lossAtPrinted(const std::vector<ThresholdRow>& rows);
/// The same over all models and trees.
Extent lossesAtPrinted(const ThresholdMeasurement& found);

}  // namespace palpate::study
