// Layout of a plot within its panel: frame, axes, ticks, colour bar, legend.
#pragma once

#include <vector>

#include "report/charts/canvas.h"
#include "report/charts/legend.h"
#include "report/charts/plot.h"
#include "report/charts/ticks.h"

namespace palpate::figures {

/// Length of the strokes outside the frame that labels belong to, pixels.
inline constexpr double kTickLength = 4.0;

/// From values to pixels along one axis.
struct AxisMapping {
  Range range{};
  Scale scale = Scale::linear;
  double from_px = 0.0;
  double to_px = 1.0;

  /// Not finite where the value is not, or where a logarithmic axis has no place for it.
  double operator()(double value) const;
};

struct PlotLayout {
  Rect panel{};
  Rect frame{};  ///< the data's area
  AxisMapping x{};
  AxisMapping y{};
  std::vector<Tick> x_ticks{};
  std::vector<Tick> y_ticks{};
  Range field_range{};  ///< range of the colours
  Rect colour_bar{};    ///< empty without a field
  std::vector<Tick> colour_ticks{};
  std::vector<LegendEntry> legend{};
  double legend_top = 0.0;

  Vec2 operator()(const Vec2& place) const { return {x(place.x()), y(place.y())}; }
};

PlotLayout computeLayout(const Plot& plot, const Rect& panel, const Canvas& canvas);

}  // namespace palpate::figures
