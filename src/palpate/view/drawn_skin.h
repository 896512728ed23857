// The deformed positions as they are on the graphics card, kept for what is computed from them: resting fingers,
// sections, arrows. Only what changed is copied.
#pragma once

#include <vector>

#include "palpate/deform/surface.h"

namespace palpate::view {

class DrawnSkin {
 public:
  void copy(const deform::DeformedSurface& surface, deform::VertexRange range) {
    places_.resize(surface.vertices());
    for (Index v = range.first; v < range.end; ++v) places_[v] = surface.positionAt(v);
  }
  Vec3 at(Index v) const { return places_[v].cast<double>(); }
  const Vec3f& placeOf(Index v) const { return places_[v]; }
  bool empty() const { return places_.empty(); }

 private:
  std::vector<Vec3f> places_;
};

}  // namespace palpate::view
