// How well letters stand out from what lies behind them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace palpate::support {

/// sRGB, 0 to 255.
using SeenColour = std::array<double, 3>;

/// Contrast as the Web Content Accessibility Guidelines 2.1 define it: 1 to 21; 4.5 is wanted of text, 3 of lines.
inline double contrastOf(const SeenColour& a, const SeenColour& b) {
  const auto luminance = [](const SeenColour& colour) {
    const std::array<double, 3> share = {0.2126, 0.7152, 0.0722};
    double sum = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double c = colour[i] / 255.0;
      sum += share[i] * (c <= 0.03928 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
    }
    return sum;
  };
  const auto [low, high] = std::minmax({luminance(a), luminance(b)});
  return (high + 0.05) / (low + 0.05);
}

/// What is seen of a colour of this opacity, 0 to 1, over another.
inline SeenColour blended(const SeenColour& below, const SeenColour& above, double opacity) {
  SeenColour seen{};
  for (std::size_t i = 0; i < 3; ++i) seen[i] = below[i] + opacity * (above[i] - below[i]);
  return seen;
}

}  // namespace palpate::support
