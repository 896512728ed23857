// Layout of a plot: legend and titles take their rows first, then ticks are chosen for the rest, and their texts decide
// how wide the margins are.
#include "report/charts/plot_layout.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "report/charts/lettering.h"

namespace palpate::figures {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Pixels between labelled ticks, at the least.
constexpr double kTickPitchX = 62.0;
constexpr double kTickPitchY = 38.0;
constexpr double kColourBarWidth = 14.0;
constexpr double kColourBarGap = 14.0;

class Extent {
 public:
  explicit Extent(Scale scale) : logarithmic_(scale == Scale::logarithmic) {}
  void add(double value) {
    if (!std::isfinite(value) || (logarithmic_ && value <= 0.0)) return;
    range_.from = std::min(range_.from, value);
    range_.to = std::max(range_.to, value);
  }
  /// [0, 1] (or [1, 10]) for nothing at all.
  Range range() const {
    if (range_.from <= range_.to) return range_;
    return logarithmic_ ? Range{1.0, 10.0} : Range{0.0, 1.0};
  }

 private:
  bool logarithmic_;
  Range range_{kInfinity, -kInfinity};
};

// Everything that has a place along one axis (0: x, 1: y).
Extent axisExtent(const Plot& plot, int axis, Scale scale) {
  Extent extent(scale);
  for (const Series& series : plot.series) {
    for (const double value : axis == 0 ? series.x : series.y) extent.add(value);
  }
  for (const Shape& shape : plot.shapes) {
    for (const auto& path : shape.paths) {
      for (const Vec2& point : path) extent.add(point[axis]);
    }
  }
  for (const Arrow& arrow : plot.arrows) {
    extent.add(arrow.from[axis]);
    extent.add(arrow.to[axis]);
  }
  for (const Place& place : plot.places) extent.add(place.at[axis]);
  return extent;
}

Range fieldExtent(const Field& field, int axis) {
  const int count = axis == 0 ? field.columns : field.rows;
  return {field.origin[axis], field.origin[axis] + (count - 1) * field.step[axis]};
}

Range shownRange(const Plot& plot, int axis, int most_ticks) {
  const Axis& settings = axis == 0 ? plot.x : plot.y;
  Range range;
  if (plot.field) {  // a map fills its frame to the last value
    range = fieldExtent(*plot.field, axis);
  } else {
    range = niceRange(axisExtent(plot, axis, settings.scale).range(), settings.scale, most_ticks);
  }
  return {settings.from.value_or(range.from), settings.to.value_or(range.to)};
}

std::vector<Tick> chooseTicks(const Axis& axis, const Range& range, int most) {
  if (axis.hidden) return {};
  if (!axis.ticks.empty()) return axis.ticks;
  return niceTicks(range, axis.scale, most);
}

double widest(const Canvas& canvas, const std::vector<Tick>& ticks) {
  double width = 0.0;
  for (const Tick& tick : ticks) width = std::max(width, canvas.textBox({0.0, 0.0}, tick.text, {}).width());
  return width;
}

Range colourRange(const Field& field) {
  Extent extent(Scale::linear);
  for (const double value : field.values) extent.add(value);
  Range range{field.from.value_or(extent.range().from), field.to.value_or(extent.range().to)};
  if (range.from == range.to) range = niceRange(range, Scale::linear, 4);
  return range;
}

int maxTicks(double length_px, double pitch_px) { return std::max(2, static_cast<int>(length_px / pitch_px)); }

// Shrinks the frame about its centre until both axes have the same pixels a unit.
void equaliseAspect(PlotLayout& layout) {
  Rect& frame = layout.frame;
  const double wide = layout.x.range.to - layout.x.range.from;
  const double high = layout.y.range.to - layout.y.range.from;
  const double pixels = std::min(frame.width() / wide, frame.height() / high);
  const double spare_x = 0.5 * (frame.width() - pixels * wide);
  frame = {frame.left + spare_x, frame.top, frame.right - spare_x, frame.top + pixels * high};
}

void placeAxes(PlotLayout& layout) {
  layout.x.from_px = layout.frame.left;
  layout.x.to_px = layout.frame.right;
  layout.y.from_px = layout.frame.bottom;
  layout.y.to_px = layout.frame.top;
}

double leftMargin(const Plot& plot, const PlotLayout& layout, const Canvas& canvas) {
  if (plot.y.hidden) return std::max(kGap, plot.least_left_px);
  const double label = plot.y.label.empty() ? 0.0 : kLineHeight + kGap;
  return std::max(label + widest(canvas, layout.y_ticks) + kTickLength + kGap, plot.least_left_px);
}

double bottomMargin(const Plot& plot) {
  if (plot.x.hidden) return kGap;
  const double label = plot.x.label.empty() ? 0.0 : kLineHeight;
  return kTickLength + kGap + kLineHeight + label;
}

double rightMargin(const Plot& plot, const PlotLayout& layout, const Canvas& canvas) {
  const double half_last_tick = layout.x_ticks.empty() ? 0.0 : 0.5 * widest(canvas, layout.x_ticks);
  if (!plot.field) return std::max(half_last_tick, kGap);
  const double label = plot.field->label.empty() ? 0.0 : kLineHeight + kGap;
  return kColourBarGap + kColourBarWidth + kTickLength + kGap + widest(canvas, layout.colour_ticks) + label;
}

void layoutTicks(const Plot& plot, PlotLayout& layout, const Rect& room) {
  int most_x = maxTicks(room.width() * 0.8, kTickPitchX);
  const int most_y = maxTicks(room.height() * 0.75, kTickPitchY);
  layout.x = {shownRange(plot, 0, most_x), plot.x.scale};
  layout.y = {shownRange(plot, 1, most_y), plot.y.scale};
  layout.x_ticks = chooseTicks(plot.x, layout.x.range, most_x);
  layout.y_ticks = chooseTicks(plot.y, layout.y.range, most_y);
  if (!plot.field) return;
  layout.field_range = colourRange(*plot.field);
  layout.colour_ticks = niceTicks(layout.field_range, Scale::linear, most_y);
}

void layoutColourBar(PlotLayout& layout) {
  const double left = layout.frame.right + kColourBarGap;
  layout.colour_bar = {left, layout.frame.top, left + kColourBarWidth, layout.frame.bottom};
}

}  // namespace

double AxisMapping::operator()(double value) const {
  const auto place = [this](double v) { return scale == Scale::logarithmic ? std::log10(v) : v; };
  const double share = (place(value) - place(range.from)) / (place(range.to) - place(range.from));
  return from_px + share * (to_px - from_px);
}

PlotLayout computeLayout(const Plot& plot, const Rect& panel, const Canvas& canvas) {
  PlotLayout layout{.panel = panel};
  if (plot.legend) layout.legend = legendEntries(plot);
  const double legend_height = kLineHeight * legendRows(canvas, layout.legend, panel.width());
  Rect room = panel;
  if (!plot.title.empty()) room.top += kTitleSize + 2.0 * kGap;
  room.bottom -= legend_height > 0.0 ? legend_height + kGap : 0.0;
  layoutTicks(plot, layout, room);
  layout.frame = {room.left + leftMargin(plot, layout, canvas), room.top + kGap,
                  room.right - rightMargin(plot, layout, canvas), room.bottom - bottomMargin(plot)};
  if (plot.equal_aspect) equaliseAspect(layout);
  placeAxes(layout);
  layout.legend_top = layout.frame.bottom + bottomMargin(plot) + kGap;
  if (plot.field) layoutColourBar(layout);
  return layout;
}

}  // namespace palpate::figures
