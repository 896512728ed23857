// Uploaded as it is, first row on top, with smaller copies for where it is shown small. At a change of picture.
#include "palpate/view/offscreen.h"

#include "palpate/view/layers/gl_objects.h"

namespace palpate::view {

struct FlatPicture::Objects {
  GlTexture picture;
};

FlatPicture::FlatPicture(const Image& image) : objects_(std::make_unique<Objects>()) {
  glBindTexture(GL_TEXTURE_2D, objects_->picture.get());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, image.width, image.height, 0, GL_RGB, GL_UNSIGNED_BYTE, image.pixels.data());
  glGenerateMipmap(GL_TEXTURE_2D);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glBindTexture(GL_TEXTURE_2D, 0);
}

FlatPicture::~FlatPicture() = default;
FlatPicture::FlatPicture(FlatPicture&&) noexcept = default;
FlatPicture& FlatPicture::operator=(FlatPicture&&) noexcept = default;

GlId FlatPicture::texture() const { return objects_->picture.get(); }

}  // namespace palpate::view
