// The deformed skin as it is on the graphics card, kept for what is computed from it: resting fingers, arrows, rings.
// Only what changed is copied.
#pragma once

#include <vector>

#include "palpate/deform/surface.h"

namespace palpate::view {

class DrawnSkin {
 public:
  /// Copies what the surface's last apply wrote.
  void follow(const deform::DeformedSurface& surface) {
    changed_.assign(surface.changed().begin(), surface.changed().end());
    for (const deform::VertexRange& range : changed_) copy(surface, range);
  }
  void copyAll(const deform::DeformedSurface& surface) {
    places_.resize(surface.vertices());
    normals_.resize(surface.vertices());
    changed_ = {{0, surface.vertices()}};
    copy(surface, changed_.front());
  }
  Vec3 at(Index v) const { return places_[v].cast<double>(); }
  Vec3 normalAt(Index v) const { return normals_[v].cast<double>(); }
  Index vertices() const { return static_cast<Index>(places_.size()); }
  /// Where it may differ from rest, or did in the picture before.
  const std::vector<deform::VertexRange>& changed() const { return changed_; }

 private:
  void copy(const deform::DeformedSurface& surface, deform::VertexRange range) {
    for (Index v = range.first; v < range.end; ++v) {
      places_[v] = surface.positionAt(v);
      normals_[v] = surface.normalAt(v);
    }
  }

  std::vector<Vec3f> places_, normals_;
  std::vector<deform::VertexRange> changed_;
};

}  // namespace palpate::view
