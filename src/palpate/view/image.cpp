#include "palpate/view/image.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_ONLY_PNG
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>

#include <cstring>
#include <memory>

#include "palpate/base/error.h"

namespace palpate::view {

namespace {

Pixel meanOf(const Image& image, int x0, int y0, int factor) {
  std::array<int, 3> sum{};
  for (int y = y0; y < y0 + factor; ++y) {
    for (int x = x0; x < x0 + factor; ++x) {
      for (std::size_t c = 0; c < 3; ++c) sum[c] += image.at(x, y)[c];
    }
  }
  const int count = factor * factor;
  Pixel mean;
  for (std::size_t c = 0; c < 3; ++c) mean[c] = static_cast<std::uint8_t>((sum[c] + count / 2) / count);
  return mean;
}

}  // namespace

Image reduced(const Image& image, int factor) {
  Image small(image.width / factor, image.height / factor);
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) small.at(x, y) = meanOf(image, x * factor, y * factor, factor);
  }
  return small;
}

void writePng(const std::filesystem::path& file, const Image& image) {
  constexpr int kChannels = 3;
  if (stbi_write_png(file.c_str(), image.width, image.height, kChannels, image.pixels.data(),
                     image.width * kChannels) == 0) {
    throw Error::inFile(file.string(), "cannot be written");
  }
}

Image readPng(const std::filesystem::path& file) {
  Image image;
  constexpr int kChannels = 3;
  const std::unique_ptr<stbi_uc, void (*)(void*)> bytes(
      stbi_load(file.c_str(), &image.width, &image.height, nullptr, kChannels), stbi_image_free);
  if (!bytes) throw Error::inFile(file.string(), "is not a PNG file that can be read");
  image.pixels.resize(static_cast<std::size_t>(image.width) * image.height);
  std::memcpy(image.pixels.data(), bytes.get(), image.pixels.size() * sizeof(Pixel));
  return image;
}

}  // namespace palpate::view
