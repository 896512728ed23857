// Matches dots of the second picture with those of the grid.
//
//   DotGrid, marks of the second picture ─ matchDots ─► DotMatch ─► fitField ─ matchAt ─► DotMatch, twice
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/measure/dot_grid.h"

namespace palpate::measure {

struct DotMatch {
  std::vector<std::optional<std::size_t>> of;  ///< one a dot of the grid: its mark in the second picture
  std::size_t count = 0;
};

/// From nothing: a common shift of the dots that hardly moved, then inwards from dot to dot.
DotMatch matchDots(const DotGrid& grid, std::span<const Dot> after);

/// Matches at a fit's predictions, px: closer, and without dots that are partly hidden.
DotMatch matchAt(const DotGrid& grid, std::span<const Vec2> predicted_px, std::span<const Dot> after);

}  // namespace palpate::measure
