// Colour maps for pictures of fields: a number in [0, 1] becomes a colour that says "more" or "less" to every eye.
//
// Based on:
//  viridis    Smith, van der Walt, Firing, 2015 (CC0): eleven knots of the published table, interpolated.
//  cividis    Nunez, Anderton, Renslow, "Optimizing colormaps with consideration for color vision deficiency", PLOS ONE
//             2018 (CC0): ten knots of the published table, interpolated. Looks the same without red-green vision.
//  cool_warm  Moreland, "Diverging color maps for scientific visualization", 2009: computed here by the paper's formula
//             (polar CIELAB, "Msh") from its two ends. Blue below, light grey in the middle, red above.
//  cyclic     a circle of constant lightness and chroma in Oklab (Ottosson 2020, public domain): for directions, where
//             both ends of the range are the same.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace palpate {

/// The order is that of kColourMapNames.
enum class ColourMap : std::uint8_t { viridis, cividis, cool_warm, cyclic };
inline constexpr std::array<std::string_view, 4> kColourMapNames{"viridis", "cividis", "cool-warm", "cyclic"};

/// sRGB, each 0 to 1.
struct Colour {
  double red = 0.0;
  double green = 0.0;
  double blue = 0.0;
};

/// Red, green, blue, 0 to 255.
using ColourBytes = std::array<std::uint8_t, 3>;

/// The colour of "no value" in every map: a neutral middle grey.
inline constexpr Colour kNoColour{0.5, 0.5, 0.5};

/// The colour of a value in [0, 1]; outside it is clamped (cyclic: wrapped round); NaN is kNoColour. Any thread.
Colour colourOf(ColourMap map, double value) noexcept;

ColourBytes bytesOf(const Colour& colour) noexcept;

}  // namespace palpate
