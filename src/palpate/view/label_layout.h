// Where plates of words go on a page: beside what they speak of, over nothing that is already there. Pure.
#pragma once

#include <span>

#include "palpate/view/drawing.h"

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

}  // namespace palpate::view
