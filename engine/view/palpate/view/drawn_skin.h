// The deformed skin as it is on the graphics card, kept for drawing from it: resting fingers, arrows, rings. Only
// changes are copied.
#pragma once

#include <utility>
#include <vector>

#include "palpate/deform/surface.h"

namespace palpate::view {

class DrawnSkin {
 public:
  /// Copies the result of the surface's last apply.
  void follow(const deform::DeformedSurface& surface) {
    changed_.assign(surface.changed().begin(), surface.changed().end());
    for (const deform::VertexRange& range : changed_) copy(surface, range);
  }
  void copyAll(const deform::DeformedSurface& surface) {
    origin_ = surface.origin();
    places_.resize(surface.vertices());
    normals_.resize(surface.vertices());
    changed_ = {{0, surface.vertices()}};
    copy(surface, changed_.front());
  }
  /// The share of the breath's lift per vertex (BreathField::share); empty for a body that does not breathe.
  void setBreath(std::vector<float> shares) { breath_ = std::move(shares); }
  /// Sets the breath's present motion of the body.
  void lift(float lift_mm) { lift_mm_ = lift_mm; }
  double liftMm() const { return lift_mm_; }
  Vec3 at(Index v) const {
    const Vec3 place = origin_ + places_[v].cast<double>();
    return breath_.empty() ? place : Vec3(place + Vec3(0, 0, lift_mm_ * breath_[v]));
  }
  Vec3 normalAt(Index v) const { return normals_[v].cast<double>(); }
  Index vertices() const { return static_cast<Index>(places_.size()); }
  /// Ranges that may differ from rest, or did in the picture before.
  const std::vector<deform::VertexRange>& changed() const { return changed_; }

 private:
  void copy(const deform::DeformedSurface& surface, deform::VertexRange range) {
    for (Index v = range.first; v < range.end; ++v) {
      places_[v] = surface.positionAt(v);
      normals_[v] = surface.normalAt(v);
    }
  }

  Vec3 origin_ = Vec3::Zero();
  std::vector<Vec3f> places_, normals_;
  std::vector<float> breath_;
  float lift_mm_ = 0.0f;
  std::vector<deform::VertexRange> changed_;
};

}  // namespace palpate::view
