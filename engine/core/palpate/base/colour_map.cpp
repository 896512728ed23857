// Colour maps as a few knots (viridis, cividis), as a path through CIELAB (cool to warm) or round a circle of Oklab
// (cyclic). Used by pictures, figures and written surfaces; all cold paths.
//
// Based on: Nunez, Anderton, Renslow, "Optimizing colormaps with consideration for color vision deficiency", 2018
// (cividis); Moreland, "Diverging color maps for scientific visualization", 2009; Ottosson, "A perceptual color space
// for image processing" (Oklab), 2020.
#include "palpate/base/colour_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

#include "palpate/base/elementary.h"

namespace palpate {

namespace {

constexpr std::array<ColourBytes, 11> kViridis{{{68, 1, 84},
                                                {72, 37, 118},
                                                {65, 68, 135},
                                                {53, 96, 141},
                                                {42, 120, 142},
                                                {33, 144, 140},
                                                {34, 168, 132},
                                                {67, 191, 113},
                                                {122, 209, 81},
                                                {187, 223, 39},
                                                {253, 231, 37}}};

constexpr std::array<ColourBytes, 10> kCividis{{{0, 32, 77},
                                                {0, 51, 111},
                                                {57, 72, 107},
                                                {87, 92, 109},
                                                {112, 113, 115},
                                                {138, 135, 121},
                                                {166, 157, 117},
                                                {196, 181, 108},
                                                {228, 207, 91},
                                                {255, 234, 70}}};

Colour betweenKnots(std::span<const ColourBytes> knots, double value) {
  constexpr double kFull = 255.0;
  const double position = value * static_cast<double>(knots.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(position), knots.size() - 2);
  const double t = position - static_cast<double>(i);
  const auto mixed = [&](std::size_t c) { return ((1.0 - t) * knots[i][c] + t * knots[i + 1][c]) / kFull; };
  return {mixed(0), mixed(1), mixed(2)};
}

/// The sRGB transfer curve (IEC 61966-2-1), clamped to what a screen can show.
double encoded(double linear) {
  const double value = linear <= 0.0031308 ? 12.92 * linear : 1.055 * elementary::pow(linear, 1.0 / 2.4) - 0.055;
  return std::clamp(value, 0.0, 1.0);
}

/// Polar CIELAB of Moreland's paper: magnitude, saturation angle, hue.
struct Msh {
  double magnitude;
  double saturation;
  double hue;
};

/// CIELAB under D65 to sRGB.
Colour colourOf(const Msh& msh) {
  const double lightness = msh.magnitude * elementary::cos(msh.saturation);
  const double chroma = msh.magnitude * elementary::sin(msh.saturation);
  const double fy = (lightness + 16.0) / 116.0;
  const auto inverse = [](double f) { return f > 6.0 / 29.0 ? f * f * f : (f - 16.0 / 116.0) * 108.0 / 841.0; };
  const double x = 0.9505 * inverse(fy + chroma * elementary::cos(msh.hue) / 500.0);
  const double y = inverse(fy);
  const double z = 1.089 * inverse(fy - chroma * elementary::sin(msh.hue) / 200.0);
  return {encoded(3.2406 * x - 1.5372 * y - 0.4986 * z), encoded(-0.9689 * x + 1.8758 * y + 0.0415 * z),
          encoded(0.0557 * x - 0.2040 * y + 1.0570 * z)};
}

/// Moreland's "cool to warm": both ends have magnitude 80 and saturation 1.08; the middle is a grey of magnitude 88,
/// whose hue is spun so that the way to either end stays even.
Colour coolWarm(double value) {
  constexpr Msh kBlue{80.0, 1.08, -1.1};
  constexpr Msh kRed{80.0, 1.08, 0.5};
  constexpr double kMiddle = 88.0;
  const Msh& end = value < 0.5 ? kBlue : kRed;
  const double t = std::abs(2.0 * value - 1.0);  // 0 in the middle, 1 at the end
  const double reach = std::sqrt(kMiddle * kMiddle - end.magnitude * end.magnitude);
  const double spin = end.saturation * reach / (end.magnitude * elementary::sin(end.saturation));
  const double grey_hue = end.hue > -std::numbers::pi / 3 ? end.hue + spin : end.hue - spin;
  return colourOf(Msh{kMiddle + t * (end.magnitude - kMiddle), t * end.saturation,  //
                      grey_hue + t * (end.hue - grey_hue)});
}

/// Lightness 0.75 and chroma 0.12 fit into sRGB at every hue.
Colour onOklabCircle(double value) {
  constexpr double kLightness = 0.75;
  constexpr double kChroma = 0.12;
  const double hue = 2.0 * std::numbers::pi * value;
  const double a = kChroma * elementary::cos(hue);
  const double b = kChroma * elementary::sin(hue);
  const auto cube = [](double v) { return v * v * v; };
  const double l = cube(kLightness + 0.3963377774 * a + 0.2158037573 * b);
  const double m = cube(kLightness - 0.1055613458 * a - 0.0638541728 * b);
  const double s = cube(kLightness - 0.0894841775 * a - 1.2914855480 * b);
  return {encoded(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          encoded(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          encoded(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

}  // namespace

Colour colourOf(ColourMap map, double value) noexcept {
  if (std::isnan(value)) return kNoColour;
  const double clamped = std::clamp(value, 0.0, 1.0);
  switch (map) {
    case ColourMap::cividis:
      return betweenKnots(kCividis, clamped);
    case ColourMap::cool_warm:
      return coolWarm(clamped);
    case ColourMap::cyclic:
      return std::isinf(value) ? kNoColour : onOklabCircle(value - std::floor(value));
    case ColourMap::viridis:
      break;
  }
  return betweenKnots(kViridis, clamped);
}

ColourBytes bytesOf(const Colour& colour) noexcept {
  const auto byte = [](double v) { return static_cast<std::uint8_t>(std::lround(std::clamp(v, 0.0, 1.0) * 255.0)); };
  return {byte(colour.red), byte(colour.green), byte(colour.blue)};
}

}  // namespace palpate
