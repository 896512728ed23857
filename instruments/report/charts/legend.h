// Legends of lines, markers and colours: rows of samples with their names, and the colour bar next to a map.
#pragma once

#include <string>
#include <vector>

#include "report/charts/canvas.h"
#include "report/charts/plot.h"
#include "report/charts/ticks.h"

namespace palpate::figures {

struct LegendEntry {
  std::string name{};
  Stroke stroke = Stroke::none;
  Marker marker = Marker::none;
  Colour colour{};
  bool filled = false;  ///< a patch of colour instead of a line
  double width_px = 1.8;
};

/// The entries of a plot: its series and shapes that have a name.
std::vector<LegendEntry> legendEntries(const Plot& plot);
/// The colour a series is drawn in.
Colour colourOf(const Plot& plot, std::size_t series);

/// Rows that the entries take when set from left to right within the width.
int legendRows(const Canvas& canvas, const std::vector<LegendEntry>& entries, double width);
/// Centred rows from `top` downwards.
void drawLegend(Canvas& canvas, const std::vector<LegendEntry>& entries, const Rect& panel, double top);

/// A vertical bar with ticks and a label on its right.
void drawColourBar(Canvas& canvas, const Rect& bar, ColourMap colours, const Range& range,
                   const std::vector<Tick>& ticks, const std::string& label);

}  // namespace palpate::figures
