// The bones under the skin, of one ivory, darker the deeper they are. Bones that opaque skin hides are not drawn:
// visibility is computed again only when the eye has moved.
#pragma once

#include <limits>
#include <vector>

#include "palpate/scene/world.h"
#include "palpate/view/layers/gl_objects.h"
#include "palpate/view/layers/viewpoint.h"
#include "palpate/view/look.h"

namespace palpate::view {

class BoneLayer {
 public:
  BoneLayer();
  /// Shows another world's; the program stays. The world must outlive the layer or the next call.
  void setWorld(const scene::World& world);
  /// The same for a world with the same body.
  void setSameBody(const scene::World& world) { world_ = &world; }
  void draw(const Look& look, const Viewpoint& viewpoint);

 private:
  /// A bone's part of the indices.
  struct Range {
    Index first = 0;
    Index count = 0;
    bool hidden = false;  // from hidden_from_
  };
  void findHidden(const Vec3f& eye);

  const scene::World* world_ = nullptr;
  Program program_;
  GlVertexArray vertex_array_;
  GlBuffer vertices_, triangles_;
  std::vector<Range> bones_;
  Vec3f hidden_from_ = Vec3f::Constant(std::numeric_limits<float>::quiet_NaN());
};

}  // namespace palpate::view
