// Medians and quantiles of values in any order. Each takes a copy, which it sorts as far as needed; values with weights
// come sorted.
#pragma once

#include <algorithm>
#include <compare>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace palpate {

/// The value in the middle; of an even number the mean of the two. 0 of nothing.
inline double medianOf(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

/// The value in the middle; for an even number the larger of the two, so that it is always one of the values. 0 for
/// none.
template <class Value>
Value upperMedianOf(std::vector<Value> values) {
  if (values.empty()) return Value{};
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Linear between ranks: of 0 and 10 the share 0.25 is 2.5. `share` from 0 to 1. NaN of nothing.
inline double quantileOf(std::vector<double> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const double rank = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (rank - static_cast<double>(below)) * (values[above] - values[below]);
}

struct WeighedValue {
  double value = 0.0;
  double weight = 0.0;
  friend auto operator<=>(const WeighedValue&, const WeighedValue&) = default;
};

/// The least value with this share of all weight at or below it. `sorted` rises and is not empty.
inline double weighedQuantile(std::span<const WeighedValue> sorted, double share) {
  double all = 0.0;
  for (const WeighedValue& each : sorted) all += each.weight;
  double below = 0.0;
  for (const WeighedValue& each : sorted) {
    below += each.weight;
    if (below >= share * all) return each.value;
  }
  return sorted.back().value;
}

}  // namespace palpate
