// Decoded by the processor, halved until it fits, turned over (OpenGL counts rows from below) and uploaded as sRGB, so
// that filters and mipmaps average light. At a change of world; an unchanged picture stays.
#include "palpate/view/layers/skin_picture.h"

#include <fmt/format.h>

#include <algorithm>

#include "palpate/view/made_skin.h"

namespace palpate::view {

namespace {

/// Halves the image until the graphics card accepts it.
Image fitting(Image image) {
  GLint most = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
  while (image.width > most || image.height > most) image = reduced(image, 2);
  return image;
}

/// Rows from bottom to top, as places in the picture count; averaged as light, not as bytes (sRGB).
void upload(GLuint name, Image image) {
  for (int y = 0; y < image.height / 2; ++y) {
    const auto upper = image.pixels.begin() + static_cast<std::ptrdiff_t>(y) * image.width;
    const auto lower = image.pixels.begin() + static_cast<std::ptrdiff_t>(image.height - 1 - y) * image.width;
    std::swap_ranges(upper, upper + image.width, lower);
  }
  fillTexture(name, image, GL_SRGB8, GL_REPEAT);
}

}  // namespace

Image decodedPicture(const scene::SkinTexture& texture) {
  if (texture.made) return paintedSkin(*texture.made);
  const std::string file = texture.source.file.string();
  const ImageSize size = readImageSize(texture.picture);
  if (std::max(size.width, size.height) > kMaxPictureSide) {
    scene::failForTexture(texture.source, fmt::format("{}: has {} x {} pixels; the most are {} along a side", file,
                                                      size.width, size.height, kMaxPictureSide));
  }
  Image image = decodeImage(texture.picture);
  if (image.pixels.empty()) scene::failForTexture(texture.source, file + ": is a broken picture");
  return image;
}

void SkinPicture::show(std::shared_ptr<const scene::SkinTexture> texture) {
  if (texture == texture_) return;
  if (texture) upload(picture_.get(), fitting(decodedPicture(*texture)));
  texture_ = std::move(texture);
}

void SkinPicture::bind() const {
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, picture_.get());
}

}  // namespace palpate::view
