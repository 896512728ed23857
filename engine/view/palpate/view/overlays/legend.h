// The colour bar: the values of the skin's colours, and the finger's value.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/colour_map.h"
#include "palpate/contact/finger_state.h"
#include "palpate/deform/surface.h"
#include "palpate/scene/world.h"
#include "palpate/view/layers/drawing.h"
#include "palpate/view/lines.h"
#include "palpate/view/look.h"
#include "palpate/view/overlays/plates.h"

namespace palpate::view {

/// The scale of the skin's colours: field, colour map, unit. The skin is coloured and the legend is drawn from the same
/// colour maps, so that a pixel can be read back.
struct ColourScale {
  ColourMap map;
  std::string_view title;
  std::string_view unit;
};

/// Strain: blue compression, red tension. Colouring::plain has none.
std::optional<ColourScale> findColourScale(Colouring colouring);
/// The same for a look on this world; a scalar's title is the look's own string. Empty where the body has no such
/// scalar.
std::optional<ColourScale> findColourScale(const Look& look, const scene::World& world);

/// Place of a value in a range, 0 to 1; beyond the ends it may be less or more.
inline double rangeFraction(const ColourRange& range, double value) {
  return (value - range.low) / (range.high - range.low);
}

/// The field of the look's colouring under a finger in contact, in the unit of its scale.
std::optional<double> valueUnder(const scene::World& world, const deform::DeformedSurface& surface, const Look& look,
                                 const contact::FingerOutput& finger);

struct Legend {
  std::string title;
  std::string unit;
  std::string low_word, high_word;  ///< text for the ends; may be empty
  ColourRange range;
  ColourMap map = ColourMap::viridis;
  struct Mark {
    double value;
    ColourBytes colour;
  };
  std::vector<Mark> marks;  ///< one per finger in contact
};

/// The place of a legend's bar on its page.
struct LegendPlace {
  Vec2f corner = Vec2f::Zero();  ///< upper left of the bar
  Vec2f size = {16.0f, 160.0f};
};

/// Height above the bar's lower end, 0 to 1 within the bar, for a value.
double heightOnBar(const Legend& legend, double value);

/// Draws bar, numbers, title with unit, pointed ends (for values beyond), marks of the fingers.
void drawLegend(Drawing& page, const Legend& legend, const LegendPlace& place, const LabelInks& inks);

// The key of the overlays: a plate of their signs in their colours, each with its text.

struct KeyEntry {
  enum class Sign : std::uint8_t { line, cross, arrow, patch };
  Sign sign = Sign::line;
  Paint paint{};
  std::string words;
};

/// A row for each overlay of the look, in order, one for dents that are shaded more strongly than light would, and one
/// for the contours of dents where the picture has some.
std::vector<KeyEntry> overlayKey(const Look& look, bool dent_contours = false);

/// The area for the plate, points: rows go down, then to the right; rows without room are left out.
struct KeyPlace {
  Vec2f corner = Vec2f::Zero();
  Vec2f room = Vec2f::Zero();
};

/// Draws it and returns the area that it covers; empty without entries.
LabelBox drawOverlayKey(Drawing& page, const std::vector<KeyEntry>& entries, const KeyPlace& place,
                        const LabelInks& inks);

// Round numbers for scales: steps of 1, 2 or 5 times a power of ten.

/// The smallest 1-2-5 step that is not below `least` (> 0).
double roundStepUp(double least);
/// The largest that is not above `most` (> 0).
double roundStepDown(double most);

/// Multiples of a round step within the range, at most `most` (>= 2) of them; both ends when no multiple fits.
std::vector<double> roundMarks(double low, double high, int most);

/// With as many decimals as the step needs: "-10", "0.4"; with a true minus sign.
std::string markText(double value, double step);

}  // namespace palpate::view
