// Round numbers for axes: the ticks' places and labels, and how far an axis reaches.
#pragma once

#include <vector>

#include "report/charts/plot.h"

namespace palpate::figures {

struct Range {
  double from = 0.0;
  double to = 1.0;
};

/// The step of 1, 2 or 5 times a power of ten that divides the length into at most `most` parts (at least one).
double niceStep(double length, int most);

/// The smallest range with ends on round numbers that holds the data; a single value gets room around it. On a
/// logarithmic axis the ends are 1, 2 or 5 times a power of ten and values <= 0 are ignored.
Range niceRange(const Range& data, Scale scale, int most);

/// At most about `most` labelled ticks within the range.
std::vector<Tick> niceTicks(const Range& range, Scale scale, int most);

/// A number as an axis writes it: as few digits as the step needs, powers only where plain digits get long.
std::string tickText(double value, double step);

}  // namespace palpate::figures
