// Paints the panels of a figure: a plot with its fields of values, or a surface seen from afar.
#pragma once

#include <vector>

#include "report/charts/canvas.h"
#include "report/charts/mesh_view.h"
#include "report/charts/plot.h"
#include "report/charts/plot_layout.h"

namespace palpate::figures {

void drawPlot(Canvas& canvas, const Plot& plot, const Rect& panel);

void drawMeshView(Canvas& canvas, const MeshView& view, const Rect& panel);

// A field of values within a plot: its value at a place, its colours, its lines of equal value.

/// The lines of one level, in the field's coordinates; a closed line ends where it began. A value equal to the level
/// counts as above it.
std::vector<std::vector<Vec2>> contourLines(const Field& field, double level);

/// The value at a place, bilinear between those of the four values around it that are not outside (NaN); NaN where the
/// outside ones outweigh them, and outside the grid.
double fieldAt(const Field& field, const Vec2& place);

void drawField(Canvas& canvas, const Field& field, const PlotLayout& layout);

/// Lines, and a number on the longest line of each level where there is room for it.
void drawContours(Canvas& canvas, const Field& field, const PlotLayout& layout);

}  // namespace palpate::figures
