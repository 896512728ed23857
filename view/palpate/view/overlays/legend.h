// The colour bar: which value a colour of the skin stands for, and where the finger's value is.
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

// What the colours of the skin mean: which field, which colour map, in which unit. The skin is coloured and the legend
// is drawn from the same colour maps, so that a pixel can be read back.

struct ColourScale {
  ColourMap map;
  std::string_view title;
  std::string_view unit;
};

/// Strain: blue compression, red tension. Colouring::plain has none.
std::optional<ColourScale> scaleOf(Colouring colouring);
/// The same for what a look shows of this world: a scalar by its name, which the look keeps. None where the body has no
/// such scalar.
std::optional<ColourScale> scaleOf(const Look& look, const scene::World& world);

/// Place of a value in a range, 0 to 1; outside it may be less or more.
inline double shareOf(const ColourRange& range, double value) { return (value - range.low) / (range.high - range.low); }

/// The field of the look's colouring under a finger that touches, in the unit of its scale.
std::optional<double> valueUnder(const scene::World& world, const deform::DeformedSurface& surface, const Look& look,
                                 const contact::FingerOutput& finger);

struct Legend {
  std::string title;
  std::string unit;
  std::string low_word, high_word;  ///< what the ends mean, in words; may be empty
  ColourRange range;
  ColourMap map = ColourMap::viridis;
  struct Mark {
    double value;
    ColourBytes colour;
  };
  std::vector<Mark> marks;  ///< one a finger that touches
};

/// Where the bar of a legend lies on its page.
struct LegendPlace {
  Vec2f corner = Vec2f::Zero();  ///< upper left of the bar
  Vec2f size = {16.0f, 160.0f};
};

/// Height above the bar's lower end, 0 to 1 within the bar, for a value.
double heightOnBar(const Legend& legend, double value);

/// Bar, numbers, title with unit, pointed ends (values beyond have the colour of the end), marks of the fingers.
void drawLegend(Drawing& page, const Legend& legend, const LegendPlace& place, const LabelInks& inks);

// What the lines and patches of the overlays mean: a plate of signs in their colours, each with its words.

struct KeyEntry {
  enum class Sign : std::uint8_t { line, cross, arrow, patch };
  Sign sign = Sign::line;
  Paint paint{};
  std::string words;
};

/// A row for everything that the look draws over the skin, in the order of the overlays, one for dents that are
/// shaded more strongly than light would, and one for the contours of dents where the picture has some.
std::vector<KeyEntry> overlayKey(const Look& look, bool dent_contours = false);

/// Where the plate may lie, points: rows go down, then to the right; those that find no room are left out.
struct KeyPlace {
  Vec2f corner = Vec2f::Zero();
  Vec2f room = Vec2f::Zero();
};

/// Draws it and returns what it covers; nothing for no entries.
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
