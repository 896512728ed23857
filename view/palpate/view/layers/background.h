// What lies behind the body: a soft dark or light gradient, or white paper. Drawn after the opaque things, on the far
// plane, so that no pixel is shaded twice.
#pragma once

#include "palpate/view/layers/gl_objects.h"
#include "palpate/view/look.h"

namespace palpate::view {

class Background {
 public:
  Background();
  /// Fills what is still empty of the viewport: where the depth is that of the far plane.
  void draw(const Look& look) const;

 private:
  Program program_;
  /// Of no attributes: a core context draws nothing without one, not even vertices made of their number.
  GlVertexArray nothing_;
};

}  // namespace palpate::view
