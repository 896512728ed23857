// Words, numbers and scales around the picture: what it shows, how large it is, which way is up, how hard is pressed.
//
// Drawn on a page (drawing.h) that lies in the plane of the screen, so both eyes see it at the same place.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "palpate/view/layers/drawing.h"
#include "palpate/view/renderer.h"
#include "palpate/view/stereo.h"

namespace palpate::view {

// Where plates of words go on a page: beside what they speak of, over nothing that is already there. Pure.

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

// The few colours of labels, and text that is readable on skin, on grey and on white paper alike.

inline constexpr Ink kLightInk{{250, 250, 250}};
inline constexpr Ink kShadeInk{{20, 20, 24}, 0.72};

/// sRGB bytes of a linear colour.
ColourBytes encodedColour(const Vec3f& linear);

/// Light letters with a dark rim.
void writeLabel(Drawing& page, const Vec2f& place, std::string_view words, Align align = Align::left,
                TextSize size = TextSize::normal);

/// What the labels speak of.
struct LabelScene {
  const scene::World& world;
  const deform::DeformedSurface& surface;
  const Frame& frame;
  const Look& look;
  const Camera& camera;
  const Eyes& eyes;
};

/// Draws all labels that the settings ask for, on a page that has begun.
void drawLabels(Drawing& page, const LabelScene& scene, const LabelSettings& settings);

}  // namespace palpate::view
