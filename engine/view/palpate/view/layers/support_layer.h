// The surroundings of the body: the table or the seat of one that lies or sits (support_shape.h), the background.
#pragma once

#include <optional>

#include "palpate/scene/world.h"
#include "palpate/view/layers/gl_objects.h"
#include "palpate/view/layers/viewpoint.h"
#include "palpate/view/look.h"
#include "palpate/view/support_shape.h"

namespace palpate::view {

class SupportLayer {
 public:
  SupportLayer();
  void setWorld(const scene::World& world);

  /// Its opacity from this eye: 1 from above its top, 0 from well below, where it would hide the body. 0 in pictures
  /// that are cut out of their background.
  float opacityFor(const Look& look, const Viewpoint& viewpoint) const;
  /// Draws over the picture unless opaque.
  void draw(const Viewpoint& viewpoint, float opacity);

 private:
  std::optional<SupportSlab> slab_;
  Program program_;
  GlVertexArray vertex_array_;
  GlBuffer vertices_, triangles_;
  GLsizei count_ = 0;
};

/// The background: a soft dark or light gradient, or white paper. Drawn after the opaque things, on the far plane, so
/// that no pixel is shaded twice.
class Background {
 public:
  Background();
  /// Fills the rest of the viewport: where the depth is that of the far plane.
  void draw(const Look& look) const;

 private:
  Program program_;
  /// Without attributes: a core context draws nothing without one, not even vertices made of their number.
  GlVertexArray nothing_;
};

}  // namespace palpate::view
