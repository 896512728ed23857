// Words for limits. Cold path.
#include "palpate/base/number_range.h"

#include <fmt/format.h>

#include <cmath>

namespace palpate {

namespace {

/// Larger whole numbers are neither exact nor readable.
constexpr double kMaxDigits = 1e15;

}  // namespace

std::string readableNumber(double value) {
  if (!(std::abs(value) < kMaxDigits) || value != std::floor(value)) return fmt::format("{}", value);
  std::string digits = fmt::format("{:.0f}", std::abs(value));
  for (std::size_t end = digits.size(); end > 3; end -= 3) digits.insert(end - 3, 1, ',');
  return value < 0.0 ? "-" + digits : digits;
}

std::string NumberRange::words(std::string_view unit) const {
  const bool has_low = std::isfinite(low);
  const bool has_high = std::isfinite(high);
  if (!has_low && !has_high) return {};
  std::string words;
  if (has_low && has_high && !above_low) {
    words = fmt::format("{} to {}", readableNumber(low), readableNumber(high));
  } else {
    if (has_low) words = fmt::format("{} {}", above_low ? "above" : "at least", readableNumber(low));
    if (has_high) words += fmt::format("{}at most {}", has_low ? " and " : "", readableNumber(high));
  }
  return unit.empty() ? words : fmt::format("{} {}", words, unit);
}

std::string outOfRange(std::string_view written, const NumberRange& range, std::string_view unit) {
  return fmt::format("{} is out of range: {}", written, range.words(unit));
}

}  // namespace palpate
