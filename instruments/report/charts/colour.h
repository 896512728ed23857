// Colours of the figures.
//
// Series take the palette of Okabe and Ito ("Color Universal Design", 2008), whose colours people with any of the
// common colour vision deficiencies can distinguish; its yellow is left out, because it cannot be read on white.
#pragma once

#include <array>
#include <cstddef>

#include "palpate/base/colour_map.h"

namespace palpate::figures {

/// Shares in [0, 1]; alpha 0 is invisible.
struct Colour {
  double red = 0.0;
  double green = 0.0;
  double blue = 0.0;
  double alpha = 1.0;

  friend bool operator==(const Colour&, const Colour&) = default;
};

inline constexpr Colour kInk{0.13, 0.13, 0.13};   ///< text, axes
inline constexpr Colour kGrid{0.87, 0.87, 0.87};  ///< grid lines, never darker than the data
inline constexpr Colour kSkin{0.89, 0.74, 0.65};  ///< an untouched surface
inline constexpr Colour kPaper{1.0, 1.0, 1.0};

inline constexpr Colour kBlue{0.00, 0.45, 0.70};
inline constexpr Colour kVermilion{0.84, 0.37, 0.00};
inline constexpr Colour kGreen{0.00, 0.62, 0.45};
inline constexpr Colour kPurple{0.80, 0.47, 0.65};
inline constexpr Colour kOrange{0.90, 0.62, 0.00};
inline constexpr Colour kSky{0.34, 0.71, 0.91};

/// The colour of the i-th series of a plot; repeats after seven.
inline Colour seriesColour(std::size_t i) {
  constexpr std::array kPalette{kBlue, kVermilion, kGreen, kPurple, kOrange, kSky, kInk};
  return kPalette[i % kPalette.size()];
}

inline Colour withAlpha(Colour colour, double alpha) {
  colour.alpha = alpha;
  return colour;
}

/// Between two colours, share 0 is the first.
inline Colour mixed(const Colour& a, const Colour& b, double share) {
  const auto mix = [share](double from, double to) { return from + (to - from) * share; };
  return {mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue), mix(a.alpha, b.alpha)};
}

/// The colour of a colour map (base/colour_map.h) at a share of the shown range.
inline Colour mapColour(ColourMap map, double share) {
  const palpate::Colour colour = colourOf(map, share);
  return {colour.red, colour.green, colour.blue, 1.0};
}

}  // namespace palpate::figures
