#include "palpate/view/label_inks.h"

#include <algorithm>
#include <cmath>

namespace palpate::view {

ColourBytes encodedColour(const Vec3f& linear) {
  ColourBytes bytes;
  for (int i = 0; i < 3; ++i) {
    const double c = std::clamp<double>(linear[i], 0.0, 1.0);
    const double encoded = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
    bytes[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(std::lround(255.0 * encoded));
  }
  return bytes;
}

void writeLabel(Drawing& page, const Vec2f& place, std::string_view words, Align align, TextSize size) {
  for (const auto& [x, y] : {std::pair{-1.0f, 0.0f}, {1.0f, 0.0f}, {0.0f, -1.0f}, {0.0f, 1.0f}}) {
    page.text(place + Vec2f(x, y), words, kShadeInk, align, size);
  }
  page.text(place, words, kLightInk, align, size);
}

}  // namespace palpate::view
