// What labels are made of: places on a page for plates of words, beside what they speak of and over nothing that is
// already there, and words that are readable on skin, on a dark ground and on paper. Placing is greedy: label after
// label, each at the first of a few liked places round its point that is free.
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

// Plates of names left and right of the body, each level with its place as far as its neighbours allow.
//
// Pure: points of a page in, plates out; no GL, no letters. The same tags give the same plates.

struct NameTag {
  Vec2f dot = Vec2f::Zero();   ///< the place on the page
  Vec2f size = Vec2f::Zero();  ///< of its plate
  int rank = 0;                ///< those of the highest rank go first where there is no room
  bool in_middle = false;      ///< of the spine: while it is upright, all of these go to one side
};

struct NamePlate {
  std::size_t tag = 0;
  LabelBox box;
  Vec2f line_from = Vec2f::Zero();  ///< at the plate's edge; the line ends at the dot
};

/// What the columns keep within and out of.
struct NameGround {
  LabelBox page;
  float body_left = 0.0f;  ///< silhouette: columns stand outside it where the page has room, else over the skin
  float body_right = 0.0f;
  std::span<const LabelBox> taken = {};
};

/// No plate lies on another one, on what is taken or on a dot of a plate; tags that find no room have none.
std::vector<NamePlate> nameColumns(std::span<const NameTag> tags, const NameGround& ground);

}  // namespace palpate::view
