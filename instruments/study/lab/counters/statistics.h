// Order statistics of measured samples, as every report of this project prints them.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace palpate::lab {

struct Percentiles {
  double p50 = 0.0;
  double p99 = 0.0;
  double p99_9 = 0.0;
  double max = 0.0;
};

/// Nearest-rank percentiles; all zero for no samples. Takes the samples by value because it sorts them.
inline Percentiles computePercentiles(std::vector<double> samples) {
  if (samples.empty()) return {};
  std::sort(samples.begin(), samples.end());
  const auto at = [&](double share) {
    const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(samples.size())));
    return samples[std::min(samples.size() - 1, rank == 0 ? 0 : rank - 1)];
  };
  return {at(0.50), at(0.99), at(0.999), samples.back()};
}

}  // namespace palpate::lab
