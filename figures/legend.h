// Keeping texts apart: a label looks for a place where it hides no other.
#pragma once

#include <string>

#include "figures/canvas.h"

namespace palpate::figures {

/// True where the box lies within the bounds and meets no text drawn so far.
bool isFree(const Canvas& canvas, const Rect& box, const Rect& bounds);

/// Draws the text to the right of the point, or where there is room: left, above, below, farther away. Where there is
/// none, to the right.
void drawBeside(Canvas& canvas, const Vec2& at, const std::string& text, const Colour& colour, const Rect& bounds);

}  // namespace palpate::figures
