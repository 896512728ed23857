#include "study/array_error.h"

#include <algorithm>
#include <cmath>

namespace palpate::study {

tissue::ProfileCurve arrayProfile(int entries, tissue::TableLookup lookup) {
  tissue::ProfileSettings settings;
  settings.kind = tissue::ProfileKind::table;
  settings.rim = tissue::ProfileRim::step;
  settings.table_entries = static_cast<std::size_t>(entries);
  settings.lookup = lookup;
  return tissue::ProfileCurve(settings);
}

tissue::ProfileCurve closedProfile() {
  tissue::ProfileSettings settings;
  settings.rim = tissue::ProfileRim::step;
  return tissue::ProfileCurve(settings);
}

double worstArrayError(int entries, tissue::TableLookup lookup) {
  constexpr double kDepth = 10.0;  // mm, (4.15)
  constexpr int kSamples = 100'000;
  const tissue::ProfileCurve array = arrayProfile(entries, lookup);
  const tissue::ProfileCurve curve = closedProfile();
  double worst = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const double q = static_cast<double>(i) / kSamples;
    worst = std::max(worst, std::abs(array.at(q).value - curve.at(q).value));
  }
  return kDepth * worst;
}

}  // namespace palpate::study
