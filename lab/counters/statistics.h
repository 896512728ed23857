// Order statistics of measured samples, as every report of this project prints them.
#pragma once

#include <vector>

namespace palpate::lab {

struct Percentiles {
  double p50 = 0.0;
  double p99 = 0.0;
  double p99_9 = 0.0;
  double max = 0.0;
};

/// Nearest-rank percentiles; all zero for no samples. Takes the samples by value because it sorts them.
Percentiles percentilesOf(std::vector<double> samples);

}  // namespace palpate::lab
