// The one file that compiles stb's reader and writer, for PNG and JPEG only. Pixels are copied out of stb's memory into
// an Image. Cold path.
#include "palpate/view/image.h"

#ifndef __clang_analyzer__  // findings in there are not ours
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_WRITE_IMPLEMENTATION
#endif
#define STBI_ONLY_JPEG
#define STBI_ONLY_PNG
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>

#include <cstring>
#include <memory>

#include "palpate/base/error.h"
#include "palpate/base/text.h"

namespace palpate::view {

namespace {

constexpr int kChannels = 3;
constexpr std::uint64_t kMaxPngBytes = std::uint64_t{1} << 30;  // stb counts in ints

using StbPixels = std::unique_ptr<stbi_uc, void (*)(void*)>;

/// Copies into an image of known size; returns an empty one when there are no pixels.
Image copied(const StbPixels& pixels, Image image) {
  if (!pixels) return {};
  image.pixels.resize(static_cast<std::size_t>(image.width) * image.height);
  std::memcpy(image.pixels.data(), pixels.get(), image.pixels.size() * sizeof(Pixel));
  return image;
}

Pixel averagePixels(const Image& image, int x0, int y0, int factor) {
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
    for (int x = 0; x < small.width; ++x) small.at(x, y) = averagePixels(image, x * factor, y * factor, factor);
  }
  return small;
}

void writePng(const std::filesystem::path& file, const Image& image) {
  std::string bytes;
  const auto append = [](void* to, void* data, int size) {
    static_cast<std::string*>(to)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
  };
  if (stbi_write_png_to_func(append, &bytes, image.width, image.height, kChannels, image.pixels.data(),
                             image.width * kChannels) == 0) {
    throw Error::inFile(file.string(), "cannot be written");
  }
  writeFile(file, bytes);
}

ImageSize readImageSize(std::string_view bytes) {
  ImageSize size;
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  if (stbi_info_from_memory(data, static_cast<int>(bytes.size()), &size.width, &size.height, nullptr) == 0) return {};
  return size;
}

Image decodeImage(std::string_view bytes) {
  Image image;
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const StbPixels pixels(
      stbi_load_from_memory(data, static_cast<int>(bytes.size()), &image.width, &image.height, nullptr, kChannels),
      stbi_image_free);
  return copied(pixels, std::move(image));
}

Image readPng(const std::filesystem::path& file) {
  Image image = decodeImage(readFile(file, kMaxPngBytes));
  if (image.pixels.empty()) throw Error::inFile(file.string(), "is not a readable PNG file");
  return image;
}

}  // namespace palpate::view
