// What labels are made of: places on a page for plates of words, beside what they speak of and over nothing that is
// already there, and words that are readable on skin, on a dark ground and on paper. Placing is greedy: label after
// label, each at the first of a few liked places round its point that is free.
#pragma once

#include <span>
#include <string_view>

#include "palpate/view/layers/drawing.h"
#include "palpate/view/look.h"

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

/// What words, plates and charts are drawn with: light letters on a dark ground, dark ones on a light ground.
struct LabelInks {
  Ink letter;
  Ink rim;    ///< round letters and lines that lie on the picture itself
  Ink plate;  ///< behind letters that do not
  Ink grid;   ///< of a chart on a plate
  Ink rest;   ///< and its curves
  Ink deformed;
};
const LabelInks& inksFor(const Look& look);

/// sRGB bytes of a linear colour.
ColourBytes encodedColour(const Vec3f& linear);

/// Letters with a rim, readable on skin and ground alike.
void writeLabel(Drawing& page, const Vec2f& place, std::string_view words, const LabelInks& inks,
                Align align = Align::left, TextSize size = TextSize::normal);

}  // namespace palpate::view
