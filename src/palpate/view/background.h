// What lies behind the body: a soft grey gradient, or white paper.
#pragma once

#include "palpate/view/gl_objects.h"

namespace palpate::view {

class Background {
 public:
  Background();
  /// Fills the viewport; leaves the depth alone.
  void draw(bool white) const;

 private:
  Program program_;
  GlVertexArray
      nothing_;  // a core context draws nothing without a vertex array, not even vertices made of their number
};

}  // namespace palpate::view
