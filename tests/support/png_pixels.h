// Reads back the pixels of a PNG.
#pragma once

#include <cairo.h>

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

namespace palpate::figures {

struct Pixels {
  int width = 0;
  int height = 0;
  std::vector<std::uint32_t> values;  // 0xRRGGBB, row by row from the top

  std::uint32_t at(double x, double y) const {
    return values.at(static_cast<std::size_t>(static_cast<int>(y)) * width + static_cast<int>(x));
  }
};

inline cairo_status_t readBytes(void* source, unsigned char* data, unsigned int length) {
  auto& rest = *static_cast<std::string_view*>(source);
  if (rest.size() < length) return CAIRO_STATUS_READ_ERROR;
  std::memcpy(data, rest.data(), length);
  rest.remove_prefix(length);
  return CAIRO_STATUS_SUCCESS;
}

inline Pixels decodePng(const std::string& png) {
  std::string_view rest = png;
  cairo_surface_t* surface = cairo_image_surface_create_from_png_stream(readBytes, &rest);
  if (cairo_surface_status(surface) != CAIRO_STATUS_SUCCESS) throw std::runtime_error("no PNG");
  Pixels pixels{cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface), {}};
  const unsigned char* row = cairo_image_surface_get_data(surface);
  for (int y = 0; y < pixels.height; ++y, row += cairo_image_surface_get_stride(surface)) {
    for (int x = 0; x < pixels.width; ++x) {
      std::uint32_t value = 0;
      std::memcpy(&value, row + sizeof value * static_cast<std::size_t>(x), sizeof value);
      pixels.values.push_back(value & 0xffffffu);
    }
  }
  cairo_surface_destroy(surface);
  return pixels;
}

}  // namespace palpate::figures
