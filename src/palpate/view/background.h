// What lies behind the body: a soft grey gradient, or white paper.
#pragma once

#include "palpate/view/gl_objects.h"

namespace palpate::view {

class Background {
 public:
  Background();
  /// Fills what is still empty of the viewport: where the depth is that of the far plane.
  void draw(bool white) const;

 private:
  Program program_;
  GlVertexArray
      nothing_;  // a core context draws nothing without a vertex array, not even vertices made of their number
};

}  // namespace palpate::view
