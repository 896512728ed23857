// The valid numbers of a setting, described the same way wherever users enter one: keys of scene files, columns of
// tables, options of the command line, and the documents of all three.
#pragma once

#include <limits>
#include <string>
#include <string_view>

namespace palpate {

/// Both ends included unless `above_low`. Infinite ends set no limit; callers check first that a number is finite.
struct NumberRange {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool above_low = false;

  /// False for a nan.
  bool holds(double value) const { return value <= high && (above_low ? value > low : value >= low); }
  /// "0 to 10,800 s", "above 0 and at most 100 mm", "at least 0"; empty without limits.
  std::string words(std::string_view unit = {}) const;
};

/// "10,800", "0.25", "1e-09": whole numbers with commas.
std::string readableNumber(double value);

/// "1e12 is out of range: 0 to 10,800 s"; `written` is the user's own spelling.
std::string outOfRange(std::string_view written, const NumberRange& range, std::string_view unit = {});

}  // namespace palpate
