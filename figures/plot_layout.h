// Where the parts of a plot lie within its panel: frame, axes, ticks, colour bar, legend.
#pragma once

#include <string>
#include <vector>

#include "figures/canvas.h"
#include "figures/plot.h"
#include "figures/ticks.h"

namespace palpate::figures {

/// From values to pixels along one axis.
struct AxisMapping {
  Range range{};
  Scale scale = Scale::linear;
  double from_px = 0.0;
  double to_px = 1.0;

  /// Not finite where the value is not, or where a logarithmic axis has no place for it.
  double operator()(double value) const;
};

struct LegendEntry {
  std::string name{};
  Stroke stroke = Stroke::none;
  Marker marker = Marker::none;
  Colour colour{};
  bool filled = false;  ///< a patch of colour instead of a line
  double width_px = 1.8;
};

struct PlotLayout {
  Rect panel{};
  Rect frame{};  ///< the data's area
  AxisMapping x{};
  AxisMapping y{};
  std::vector<Tick> x_ticks{};
  std::vector<Tick> y_ticks{};
  Range field_range{};  ///< of the colours
  Rect colour_bar{};    ///< empty without a field
  std::vector<Tick> colour_ticks{};
  std::vector<LegendEntry> legend{};
  double legend_top = 0.0;

  Vec2 operator()(const Vec2& place) const { return {x(place.x()), y(place.y())}; }
};

PlotLayout layoutOf(const Plot& plot, const Rect& panel, const Canvas& canvas);

/// "label (unit)".
std::string withUnit(const std::string& label, const std::string& unit);

inline constexpr double kTextSize = 12.0;
inline constexpr double kTitleSize = 13.0;
inline constexpr double kLineHeight = 1.35 * kTextSize;
inline constexpr double kGap = 6.0;

inline constexpr TextStyle kPanelTitle{
    .size_px = kTitleSize, .bold = true, .across = Align::middle, .down = Align::start};

/// The entries of a plot: its series and shapes that have a name.
std::vector<LegendEntry> legendOf(const Plot& plot);
/// The colour a series is drawn in.
Colour colourOf(const Plot& plot, std::size_t series);

/// Rows that the entries take when set from left to right within the width.
int legendRows(const Canvas& canvas, const std::vector<LegendEntry>& entries, double width);
/// Centred rows from `top` downwards.
void drawLegend(Canvas& canvas, const std::vector<LegendEntry>& entries, const Rect& panel, double top);

// The colour bar beside a map: which colour means which value.

/// A vertical bar with ticks and a label on its right.
void drawColourBar(Canvas& canvas, const Rect& bar, ColourMap colours, const Range& range,
                   const std::vector<Tick>& ticks, const std::string& label);

}  // namespace palpate::figures
