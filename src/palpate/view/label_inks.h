// The few colours of labels, and text that is readable on skin, on grey and on white paper alike.
#pragma once

#include "palpate/view/drawing.h"

namespace palpate::view {

inline constexpr Ink kLightInk{{250, 250, 250}};
inline constexpr Ink kShadeInk{{20, 20, 24}, 0.72};

/// sRGB bytes of a linear colour.
ColourBytes encodedColour(const Vec3f& linear);

/// Light letters with a dark rim.
void writeLabel(Drawing& page, const Vec2f& place, std::string_view words, Align align = Align::left,
                TextSize size = TextSize::normal);

}  // namespace palpate::view
