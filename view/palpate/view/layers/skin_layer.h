// The skin as a picture shows it: its buffers, its programs and the user's picture on it.
#pragma once

#include <optional>
#include <span>

#include "palpate/view/layers/skin_buffers.h"
#include "palpate/view/layers/skin_paint.h"
#include "palpate/view/layers/skin_picture.h"

namespace palpate::view {

class SkinLayer {
 public:
  /// Shows another world; programs stay as they are. The world must outlive the layer or the next call. Throws Error
  /// for a texture that cannot be shown, and then still shows the world before.
  void setWorld(const scene::World& world);
  /// The same for a world with the same body.
  void setMapsOf(const scene::World& world) { buffers_->setMapsOf(world); }
  /// Of the world that is shown.
  SkinBuffers& buffers() { return *buffers_; }

  /// Draws over what is there, depth-tested; transparent where the look says so.
  void draw(const Look& look, const Viewpoint& viewpoint, const SkinTouch& touch);

 private:
  SkinNeeds needsOf(const Look& look, const Viewpoint& viewpoint) const;
  void drawColours(const Look& look, const Viewpoint& viewpoint, const SkinTouch& touch, const SplitRuns& runs);

  SkinPaint paint_;
  SkinPicture picture_;
  std::optional<SkinBuffers> buffers_;
  bool closed_ = false;
};

}  // namespace palpate::view
