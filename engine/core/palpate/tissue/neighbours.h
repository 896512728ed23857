// A place among increasing values: the two that it lies between.
#pragma once

#include <cstddef>
#include <span>

namespace palpate::tissue {

/// Neighbours among increasing values and the share of the upper; ends hold.
struct Neighbours {
  std::size_t below = 0;
  std::size_t above = 0;
  double share = 0.0;
};

/// `logarithmic`: the share is that of the logarithms.
Neighbours findNeighbours(std::span<const double> values, double at, bool logarithmic = false) noexcept;

}  // namespace palpate::tissue
