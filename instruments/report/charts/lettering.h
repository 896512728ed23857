// Lettering of figures: sizes of letters, and labels that look for a place where they hide no other.
#pragma once

#include <string>

#include "report/charts/canvas.h"

namespace palpate::figures {

inline constexpr double kTextSize = 12.0;
inline constexpr double kTitleSize = 13.0;
inline constexpr double kLineHeight = 1.35 * kTextSize;
inline constexpr double kGap = 6.0;

inline constexpr TextStyle kPanelTitle{
    .size_px = kTitleSize, .bold = true, .across = Align::middle, .down = Align::start};

/// "label (unit)".
std::string withUnit(const std::string& label, const std::string& unit);

/// True where the box is within the bounds and meets no text drawn so far.
bool isFree(const Canvas& canvas, const Rect& box, const Rect& bounds);

/// Draws the text to the right of the point, or where there is room: left, above, below, farther away. Where there is
/// none, to the right.
void drawBeside(Canvas& canvas, const Vec2& at, const std::string& text, const Colour& colour, const Rect& bounds);

}  // namespace palpate::figures
