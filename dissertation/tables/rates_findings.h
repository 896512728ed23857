// What the measured rates say beside the printed ones: sentences made of nothing but the measurement.
#pragma once

#include <string>
#include <vector>

#include "dissertation/tables/rendering_rates.h"

namespace palpate::study {

/// A paragraph each, most important first. `found` must have rows.
std::vector<std::string> ratesFindings(const RatesMeasurement& found);

}  // namespace palpate::study
