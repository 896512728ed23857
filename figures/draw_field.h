// The layers of a field: its colours and its lines of equal value.
#pragma once

#include "figures/plot_layout.h"

namespace palpate::figures {

/// The value at a place, bilinear between those of the four values around it that are not outside (NaN); NaN where the
/// outside ones outweigh them, and outside the grid.
double fieldAt(const Field& field, const Vec2& place);

void drawField(Canvas& canvas, const Field& field, const PlotLayout& layout);

/// Lines, and a number on the longest line of each level where there is room for it.
void drawContours(Canvas& canvas, const Field& field, const PlotLayout& layout);

}  // namespace palpate::figures
