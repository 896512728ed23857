// Dots of ink on skin, found in a picture by their hue.
//
//   Photograph ─ findDots ─► FoundDots ─► growGrid (dot_grid.h)
//
// Pictures count pixels from the centre of the top left one, x to the right, y down.
#pragma once

#include <optional>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/measure/photograph.h"

namespace palpate::measure {

/// The colour of a pen as a step from the skin beneath: an angle in the plane of CIELAB's a and b.
struct Ink {
  double hue_rad = 0.0;
  double peak_chroma = 0.0;  ///< peak of the middle dot, in units of a and b (8 bits)
};

struct Dot {
  Vec2 place_px = Vec2::Zero();
  double area_px = 0.0;  ///< in the full picture; 0: not known
};

struct FoundDots {
  std::vector<Dot> dots;
  Ink ink;
};

/// All marks of the commonest ink, strays among them, or those of the given ink (of the other picture of a pair). Few
/// or none are not an error. One thread; 0.5 s for 12 megapixels.
FoundDots findDots(const Photograph& picture, const std::optional<Ink>& ink = {});

}  // namespace palpate::measure
