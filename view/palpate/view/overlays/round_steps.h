// Round numbers for scales: steps of 1, 2 or 5 times a power of ten.
#pragma once

#include <string>
#include <vector>

namespace palpate::view {

/// The smallest 1-2-5 step that is not below `least` (> 0).
double roundStepUp(double least);
/// The largest that is not above `most` (> 0).
double roundStepDown(double most);

/// Multiples of a round step within the range, at most `most` (>= 2) of them; both ends when no multiple fits.
std::vector<double> roundMarks(double low, double high, int most);

/// With as many decimals as the step needs: "-10", "0.4"; with a true minus sign.
std::string markText(double value, double step);

}  // namespace palpate::view
