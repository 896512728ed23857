// The bones under the skin, darker and redder the deeper they lie.
#pragma once

#include "palpate/scene/world.h"
#include "palpate/view/look.h"
#include "palpate/view/viewpoint.h"

namespace palpate::view {

class BoneLayer {
 public:
  explicit BoneLayer(const scene::World& world);
  void draw(const Look& look, const Viewpoint& viewpoint) const;
  bool empty() const { return indices_ == 0; }

 private:
  Program program_;
  GlVertexArray vertex_array_;
  GlBuffer vertices_, triangles_;
  Index indices_ = 0;
};

}  // namespace palpate::view
