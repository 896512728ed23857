// Coordinates round the middle of a set of places, at most about 1 in size: fits in millimetre would lose digits to the
// large powers of coordinates far from the origin.
#pragma once

#include <algorithm>
#include <span>

#include "palpate/base/vec.h"

namespace palpate::maps {

struct PlaneScaling {
  Vec2 centre_mm = Vec2::Zero();
  double size_mm = 1.0;  ///< > 0

  Vec2 scaled(const Vec2& place_mm) const { return (place_mm - centre_mm) / size_mm; }
};

/// The middle of the places' bounding box and half its longer side. Without extent (no place, one place) the size is 1.
inline PlaneScaling scalingOf(std::span<const Vec2> places_mm) {
  if (places_mm.empty()) return {};
  Eigen::AlignedBox2d box;
  for (const Vec2& place : places_mm) box.extend(place);
  const double size_mm = 0.5 * box.sizes().maxCoeff();
  return {box.center(), size_mm > 0.0 ? size_mm : 1.0};
}

}  // namespace palpate::maps
