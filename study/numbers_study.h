// `palpate study numbers`: every number of the dissertation that can be computed, beside ours.
#pragma once

#include <vector>

#include "study/number_row.h"
#include "study/printed_numbers.h"

namespace palpate::study {

/// In the order of the text. Takes well under a second. Throws Error when a printed number is not a number.
std::vector<NumberRow> studyNumbers(const PrintedNumbers& printed = printedNumbers());

}  // namespace palpate::study
