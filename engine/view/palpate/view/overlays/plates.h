// Building blocks of labels: places on a page for plates of text, next to their subjects and clear of other labels, and
// text that is readable on skin, on a dark ground and on paper. Placing is greedy: label after label, each at the first
// free one of a few preferred places round its point.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "palpate/view/layers/drawing.h"
#include "palpate/view/look.h"

namespace palpate::view {

/// A rectangle of the page, points.
struct LabelBox {
  Vec2f corner = Vec2f::Zero();    ///< upper left
  Vec2f opposite = Vec2f::Zero();  ///< lower right
};

/// The area that two boxes share, square points.
float overlapArea(const LabelBox& a, const LabelBox& b);

/// A plate of this size for something at `tip`: to the right and above if there is room, else the nearest place round
/// it on the page and clear of `taken`; where there is none, the one that hides least.
LabelBox placePlate(const Vec2f& tip, const Vec2f& size, const LabelBox& page, std::span<const LabelBox> taken);

/// The corner of the plate that is nearest to a place: where the line to it begins.
Vec2f nearestCorner(const LabelBox& plate, const Vec2f& place);

/// Colours of text, plates and charts: light letters on a dark ground, dark ones on a light ground.
struct LabelInks {
  Ink letter;
  Ink rim;    ///< round letters and lines on the picture itself
  Ink plate;  ///< behind other letters
  Ink grid;   ///< for a chart on a plate
  Ink rest;   ///< for its curves
  Ink deformed;
};
const LabelInks& inksFor(const Look& look);

/// sRGB bytes of a linear colour.
ColourBytes encodedColour(const Vec3f& linear);

/// Letters with a rim, readable on skin and ground alike.
void writeLabel(Drawing& page, const Vec2f& place, std::string_view words, const LabelInks& inks,
                Align align = Align::left, TextSize size = TextSize::normal);

/// Plates of names left and right of the body, each level with its place as far as its neighbours allow.
///
/// Pure: points of a page in, plates out; no GL, no letters. The same tags give the same plates.
struct NameTag {
  Vec2f dot = Vec2f::Zero();   ///< the place on the page
  Vec2f size = Vec2f::Zero();  ///< size of its plate
  int rank = 0;                ///< where room is short, the highest ranks are dropped first
  bool in_middle = false;      ///< on the spine: while it is upright, all of these go to one side
};

struct NamePlate {
  std::size_t tag = 0;
  LabelBox box;
  Vec2f line_from = Vec2f::Zero();  ///< at the plate's edge; the line ends at the dot
};

/// Limits and obstacles of the columns.
struct NameGround {
  LabelBox page;
  float body_left = 0.0f;  ///< silhouette: columns are outside it where the page has room, else over the skin
  float body_right = 0.0f;
  std::span<const LabelBox> taken = {};
};

/// Plates never overlap each other, taken areas or dots of plates; tags without room get none.
std::vector<NamePlate> nameColumns(std::span<const NameTag> tags, const NameGround& ground);

}  // namespace palpate::view
