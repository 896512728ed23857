#include "lab/counters/statistics.h"

#include <algorithm>
#include <cmath>

namespace palpate::lab {

Percentiles percentilesOf(std::vector<double> samples) {
  if (samples.empty()) return {};
  std::sort(samples.begin(), samples.end());
  const auto at = [&](double share) {
    const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(samples.size())));
    return samples[std::min(samples.size() - 1, rank == 0 ? 0 : rank - 1)];
  };
  return {at(0.50), at(0.99), at(0.999), samples.back()};
}

}  // namespace palpate::lab
