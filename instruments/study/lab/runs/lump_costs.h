// Cost of lumps and pressure pads in a servo tick.
#pragma once

#include "palpate/base/json.h"
#include "palpate/base/progress.h"

namespace palpate::bench {

/// A fingertip of 8 mm that presses 5 to 10 mm deep and slides over the benchmark's back, for about `seconds`: tick_us
/// without lumps; tick_extra_us, more a tick with one lump under the path, eight within reach, the same on springs, and
/// eight fixed ones with a pad of 4 x 4 taxels; field_us of a pad over one lump, of 4, 8 and 16 taxels along a side,
/// and of 4 over eight lumps; allocations in all of it (null: not counted); rounds. The shortest of many blocks of
/// ticks: a busy machine makes others longer.
Json measureLumpCosts(double seconds, const Progress& progress = {});

}  // namespace palpate::bench
