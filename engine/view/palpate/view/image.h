// A picture in memory and as a PNG file, also without its background.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

namespace palpate::view {

using Pixel = std::array<std::uint8_t, 3>;

/// Rows from top to bottom, 8 bits a channel, sRGB.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<Pixel> pixels;

  Image() = default;
  Image(int w, int h, Pixel fill = {}) : width(w), height(h), pixels(static_cast<std::size_t>(w) * h, fill) {}
  Pixel& at(int x, int y) { return pixels[static_cast<std::size_t>(y) * width + x]; }
  const Pixel& at(int x, int y) const { return pixels[static_cast<std::size_t>(y) * width + x]; }
};

/// Each pixel is the mean of factor x factor; width and height must be multiples of the factor. The mean is over the
/// encoded values: lines and text keep their weight.
Image reduced(const Image& image, int factor);

struct ImageSize {
  int width = 0;
  int height = 0;
};
/// Size of a PNG or JPEG file, by its first bytes; 0 x 0 when it is neither.
ImageSize readImageSize(std::string_view bytes);
/// The picture itself, without transparency; empty when it cannot be read.
Image decodeImage(std::string_view bytes);

/// Throws Error naming the file.
void writePng(const std::filesystem::path& file, const Image& image);
[[deprecated("use decodeImage instead")]] Image readPng(const std::filesystem::path& file);

/// A picture without its background: drawn once on white and once on black, each pixel shows how much of it was
/// covered. So edges, transparent skin and everything else that lets the background through stay transparent. Its
/// colours are not mixed with any background; opacity is 0 to 255.
struct CutOut {
  Image image;
  std::vector<std::uint8_t> opacity;
};

/// Both pictures show the same and have one size.
CutOut cutOut(const Image& on_white, const Image& on_black);

/// With transparency. Throws Error naming the file.
void writePng(const std::filesystem::path& file, const CutOut& picture);

}  // namespace palpate::view
