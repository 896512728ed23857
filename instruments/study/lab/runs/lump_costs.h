// Cost of lumps and pressure pads in a servo tick.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "palpate/base/progress.h"

namespace palpate::bench {

/// Shortest of many blocks of ticks, us: a busy machine makes others longer.
struct LumpCosts {
  double tick_us = 0.0;           ///< fingertip in contact, without lumps
  double one_us = 0.0;            ///< more per tick with one lump under the path, and so on
  double eight_us = 0.0;          ///< all within reach
  double eight_mobile_us = 0.0;   ///< the same on springs, their motion counted in
  double eight_and_pad_us = 0.0;  ///< eight fixed ones and a pad of 4 x 4 taxels in every tick
  /// A pad over one lump: of 4, 8 and 16 taxels along a side; and of 4 over eight lumps.
  double field_4_us = 0.0, field_8_us = 0.0, field_16_us = 0.0, field_4_of_eight_us = 0.0;
  std::optional<std::uint64_t> allocations;  ///< in all ticks and pads; none: they cannot be counted here
  std::size_t rounds = 0;
};

/// A fingertip of 8 mm that presses 5 to 10 mm deep and slides over the benchmark's back, for about `seconds`.
LumpCosts measureLumpCosts(double seconds, const Progress& progress = {});

}  // namespace palpate::bench
