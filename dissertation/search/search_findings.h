// What the searches' measurement says: sentences made of nothing but its numbers.
#pragma once

#include <string>
#include <vector>

#include "dissertation/search/search_measurement.h"

namespace palpate::study {

/// A paragraph each, most important first.
std::vector<std::string> searchFindings(const SearchMeasurement& found);

}  // namespace palpate::study
