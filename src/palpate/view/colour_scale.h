// What the colours of the skin mean: which field, which colour map, in which unit. The skin is coloured and the legend
// is drawn from the same functions, so that a pixel can be read back.
#pragma once

#include <optional>
#include <string_view>

#include "palpate/base/colour_map.h"
#include "palpate/contact/finger.h"
#include "palpate/deform/surface.h"
#include "palpate/scene/world.h"
#include "palpate/view/look.h"

namespace palpate::view {

struct ColourScale {
  ColourMap map;
  std::string_view title;
  std::string_view unit;
};

/// Strain: blue compression, red tension. Colouring::plain has none.
std::optional<ColourScale> scaleOf(Colouring colouring);

/// Place of a value in a range, 0 to 1; outside it may be less or more.
inline double shareOf(const ColourRange& range, double value) { return (value - range.low) / (range.high - range.low); }

/// sRGB bytes of a value under this look.
ColourBytes colourOfValue(const Look& look, double value);

/// The field of the look's colouring under a finger that touches, in the unit of its scale.
std::optional<double> valueUnder(const scene::World& world, const deform::DeformedSurface& surface, const Look& look,
                                 const contact::FingerOutput& finger);

}  // namespace palpate::view
