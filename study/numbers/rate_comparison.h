// Comparing measured rates at equal numbers of triangles.
#pragma once

#include <vector>

#include "study/numbers/printed_numbers.h"

namespace palpate::study {

/// ms at that many triangles, linear between the measured ones; beyond them NaN.
double timeAt(const std::vector<PrintedTiming>& timings, double triangles);

struct Gain {
  double least = 0.0;
  double most = 0.0;
};

/// By what share the rate of `fast` exceeds that of `slow` at the triangle counts where both are known.
Gain rateGain(const std::vector<PrintedTiming>& fast, const std::vector<PrintedTiming>& slow);

}  // namespace palpate::study
