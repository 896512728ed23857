// The user's picture on the skin, on the graphics card.
#pragma once

#include <memory>

#include "palpate/scene/skin_texture.h"
#include "palpate/view/image.h"
#include "palpate/view/layers/gl_objects.h"

namespace palpate::view {

/// The pixels of a texture, decoded or painted. Needs no GL; any thread. Throws Error naming the scene file for a
/// broken picture, and for one of more than kMaxPictureSide pixels along a side.
Image decodedPicture(const scene::SkinTexture& texture);
inline constexpr int kMaxPictureSide = 16384;

class SkinPicture {
 public:
  /// Decodes and uploads the picture, unless it is shown already; null: none. Halved until the graphics card accepts
  /// it. Throws Error like decodedPicture, and keeps the one before.
  void show(std::shared_ptr<const scene::SkinTexture> texture);
  bool isThere() const { return texture_ != nullptr; }
  /// Painted: factors on the skin's own colour (view/made_skin.h), not colours.
  bool isMade() const { return texture_ != nullptr && texture_->made.has_value(); }
  /// For the program in use, as unit 0.
  void bind() const;

 private:
  std::shared_ptr<const scene::SkinTexture> texture_;
  GlTexture picture_;
};

}  // namespace palpate::view
