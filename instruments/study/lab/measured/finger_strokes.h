// Strokes over the benchmark's back, for the study of punctures: a finger that comes down, presses and slides at one
// speed.
#pragma once

#include <vector>

#include "palpate/base/vec.h"

namespace palpate::study {

struct StrokeSettings {
  int count = 40;
  double speed_mm_s = 200.0;  ///< along the whole way, from the first tick on
  double approach_mm = 20.0;  ///< through the air, up to 45 degree off the vertical
  double depth_mm = 8.0;      ///< below the skin while it slides
  double slide_mm = 120.0;    ///< seen from above, straight, in any direction
  double tick_s = 0.001;
  std::uint64_t seed = 1;
};

/// Tips, one a tick, over lab::backMesh of any size. Strokes of other speeds take the same ways.
std::vector<std::vector<Vec3>> fingerStrokes(const StrokeSettings& settings);

}  // namespace palpate::study
