// What labels are made of: places on a page for plates of words, beside what they speak of and over nothing that is
// already there, and words that are readable on skin, on grey and on white paper alike. Placing is greedy: label after
// label, each at the first of a few liked places round its point that is free.
#pragma once

#include <span>
#include <string_view>

#include "palpate/view/layers/drawing.h"

namespace palpate::view {

/// A rectangle of the page, points.
struct LabelBox {
  Vec2f corner = Vec2f::Zero();    ///< upper left
  Vec2f opposite = Vec2f::Zero();  ///< lower right
};

/// What two boxes share, square points.
float overlapOf(const LabelBox& a, const LabelBox& b);

/// A plate of this size for something at `tip`: to the right and above if there is room, else the nearest place round
/// it that lies on the page and on nothing that is `taken`; where there is none, the one that hides least.
LabelBox placePlate(const Vec2f& tip, const Vec2f& size, const LabelBox& page, std::span<const LabelBox> taken);

/// The corner of the plate that is nearest to a place: where the line to it begins.
Vec2f nearestCorner(const LabelBox& plate, const Vec2f& place);

inline constexpr Ink kLightInk{{250, 250, 250}};
inline constexpr Ink kShadeInk{{20, 20, 24}, 0.72};

/// sRGB bytes of a linear colour.
ColourBytes encodedColour(const Vec3f& linear);

/// Light letters with a dark rim.
void writeLabel(Drawing& page, const Vec2f& place, std::string_view words, Align align = Align::left,
                TextSize size = TextSize::normal);

}  // namespace palpate::view
