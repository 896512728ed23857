// The tones of skin, from light to dark, and their effects besides the colour.
//
// Pigment is over the blood: dark skin shows less redness and less light that travels under the surface. The same gloss
// shows more on it, because less light returns from the skin itself: it gets less of it, else it looks wet.
#pragma once

#include <algorithm>
#include <array>

#include "palpate/base/vec.h"

namespace palpate::view {

struct SkinTone {
  Vec3f colour;   ///< linear: reflectance
  float blood;    ///< visible share of a place's redness, 0 to 1
  float scatter;  ///< how far light travels under the surface, 0 to 1
  float sheen;    ///< factor on the gloss
};

/// From 1 (very light) to 6 (very dark), about as the six types of Fitzpatrick; fractions are interpolated.
inline SkinTone interpolateSkinTone(double tone) {
  // Own, by eye, against colour charts of the six types.
  static const std::array<SkinTone, 6> tones = {{{{0.680f, 0.450f, 0.350f}, 1.00f, 1.00f, 0.90f},
                                                 {{0.590f, 0.355f, 0.252f}, 1.00f, 1.00f, 1.00f},
                                                 {{0.490f, 0.272f, 0.176f}, 0.90f, 0.92f, 0.92f},
                                                 {{0.330f, 0.167f, 0.098f}, 0.80f, 0.80f, 0.75f},
                                                 {{0.190f, 0.091f, 0.053f}, 0.65f, 0.65f, 0.58f},
                                                 {{0.092f, 0.045f, 0.027f}, 0.50f, 0.50f, 0.48f}}};
  const double place = std::clamp(tone, 1.0, 6.0) - 1.0;
  const auto first = std::min<std::size_t>(static_cast<std::size_t>(place), tones.size() - 2);
  const auto share = static_cast<float>(place - static_cast<double>(first));
  const auto between = [&](float from, float to) { return from + share * (to - from); };
  const SkinTone& from = tones[first];
  const SkinTone& to = tones[first + 1];
  return {from.colour + share * (to.colour - from.colour), between(from.blood, to.blood),
          between(from.scatter, to.scatter), between(from.sheen, to.sheen)};
}

}  // namespace palpate::view
