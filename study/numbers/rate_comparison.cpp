#include "study/numbers/rate_comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "study/numbers/number_row.h"

namespace palpate::study {

double timeAt(const std::vector<PrintedTiming>& timings, double triangles) {
  for (std::size_t i = 1; i < timings.size(); ++i) {
    const PrintedTiming& low = timings[i - 1];
    const PrintedTiming& high = timings[i];
    if (triangles < low.triangles || triangles > high.triangles) continue;
    const double share = (triangles - low.triangles) / (high.triangles - low.triangles);
    const double from = parsePrinted(low.ms).value;
    return from + share * (parsePrinted(high.ms).value - from);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

Gain rateGain(const std::vector<PrintedTiming>& fast, const std::vector<PrintedTiming>& slow) {
  Gain gain{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const auto* table : {&fast, &slow}) {
    for (const PrintedTiming& timing : *table) {
      const double more = timeAt(slow, timing.triangles) / timeAt(fast, timing.triangles) - 1.0;
      if (!std::isfinite(more)) continue;
      gain.least = std::min(gain.least, more);
      gain.most = std::max(gain.most, more);
    }
  }
  return gain;
}

}  // namespace palpate::study
