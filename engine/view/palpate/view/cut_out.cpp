// A pixel of opacity a and colour c is a c + 255 (1 - a) on white and a c on black: their difference is a, their share
// is c. Based on: Smith and Blinn, "Blue screen matting", SIGGRAPH 1996 (two backgrounds make it exact). Cold path.
#include "palpate/view/image.h"

#include <stb/stb_image_write.h>

#include <algorithm>
#include <string>

#include "palpate/base/error.h"
#include "palpate/base/text.h"

namespace palpate::view {

CutOut cutOut(const Image& on_white, const Image& on_black) {
  CutOut cut{on_black, std::vector<std::uint8_t>(on_black.pixels.size())};
  for (std::size_t i = 0; i < cut.opacity.size(); ++i) {
    int let_through = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      let_through += std::max(0, on_white.pixels[i][c] - on_black.pixels[i][c]);
    }
    const int opacity = std::clamp(255 - (let_through + 1) / 3, 0, 255);
    cut.opacity[i] = static_cast<std::uint8_t>(opacity);
    for (std::uint8_t& colour : cut.image.pixels[i]) {
      colour = opacity == 0 ? std::uint8_t{0} : static_cast<std::uint8_t>(std::min(255, colour * 255 / opacity));
    }
  }
  return cut;
}

void writePng(const std::filesystem::path& file, const CutOut& picture) {
  constexpr int kWithOpacity = 4;
  std::string pixels;
  pixels.reserve(kWithOpacity * picture.opacity.size());
  for (std::size_t i = 0; i < picture.opacity.size(); ++i) {
    for (const std::uint8_t colour : picture.image.pixels[i]) pixels += static_cast<char>(colour);
    pixels += static_cast<char>(picture.opacity[i]);
  }
  std::string bytes;
  const auto append = [](void* to, void* data, int size) {
    static_cast<std::string*>(to)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
  };
  if (stbi_write_png_to_func(append, &bytes, picture.image.width, picture.image.height, kWithOpacity, pixels.data(),
                             picture.image.width * kWithOpacity) == 0) {
    throw Error::inFile(file.string(), "cannot be written");
  }
  writeFile(file, bytes);
}

}  // namespace palpate::view
