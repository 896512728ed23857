// A plot's layers from back to front, in the order of plot.h; series and shapes are clipped to the frame, whole markers
// and labelled places are not.
#include <cmath>

#include "report/charts/drawing.h"
#include "report/charts/legend.h"
#include "report/charts/lettering.h"
#include "report/charts/plot_layout.h"

namespace palpate::figures {

namespace {

void drawGrid(Canvas& canvas, const Plot& plot, const PlotLayout& layout) {
  if (plot.field) return;  // colours say where one is
  const Pen pen{kGrid, 0.8};
  const Rect& frame = layout.frame;
  for (const Tick& tick : layout.x_ticks) {
    canvas.line({layout.x(tick.value), frame.top}, {layout.x(tick.value), frame.bottom}, pen);
  }
  for (const Tick& tick : layout.y_ticks) {
    canvas.line({frame.left, layout.y(tick.value)}, {frame.right, layout.y(tick.value)}, pen);
  }
}

void drawShape(Canvas& canvas, const Shape& shape, const PlotLayout& layout) {
  for (const auto& path : shape.paths) {
    std::vector<Vec2> placed;
    placed.reserve(path.size());
    for (const Vec2& point : path) placed.push_back(layout(point));
    canvas.path(placed, shape.closed, Pen{shape.colour, shape.width_px, shape.stroke}, shape.fill);
  }
}

void drawCurve(Canvas& canvas, const std::vector<Vec2>& points, const Pen& pen) {
  if (points.size() > 1) canvas.path(points, false, pen);
}

void drawSeries(Canvas& canvas, const Series& series, const Colour& colour, const PlotLayout& layout) {
  const Pen pen{colour, series.width_px, series.stroke};
  std::vector<Vec2> piece;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    const Vec2 at = layout({series.x[i], series.y[i]});
    if (at.allFinite()) {
      piece.push_back(at);
      continue;
    }
    drawCurve(canvas, piece, pen);
    piece.clear();
  }
  drawCurve(canvas, piece, pen);
}

bool isInside(const Rect& rect, const Vec2& at) {
  constexpr double kSlack = 1e-6;  // a point on the frame belongs to it
  return at.x() >= rect.left - kSlack && at.x() <= rect.right + kSlack && at.y() >= rect.top - kSlack &&
         at.y() <= rect.bottom + kSlack;
}

// Whole markers also on the frame, where the curve is clipped.
void drawMarkers(Canvas& canvas, const Series& series, const Colour& colour, const PlotLayout& layout) {
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    const Vec2 at = layout({series.x[i], series.y[i]});
    if (isInside(layout.frame, at)) drawMarker(canvas, at, series.marker, colour);
  }
}

void drawArrow(Canvas& canvas, const Arrow& arrow, const PlotLayout& layout) {
  const Vec2 from = layout(arrow.from);
  const Vec2 to = layout(arrow.to);
  const double length = (to - from).norm();
  canvas.line(from, to, {arrow.colour, arrow.width_px});
  if (length < 1.0) return;
  const Vec2 along = (to - from) / length;
  const Vec2 across(-along.y(), along.x());
  const double head = std::min(7.0, 0.6 * length);
  const std::vector<Vec2> tip{to, to - head * along + 0.4 * head * across, to - head * along - 0.4 * head * across};
  canvas.path(tip, true, std::nullopt, arrow.colour);
}

void drawLayers(Canvas& canvas, const Plot& plot, const PlotLayout& layout) {
  canvas.beginClip(layout.frame);
  for (const Shape& shape : plot.shapes) drawShape(canvas, shape, layout);
  if (plot.field) drawContours(canvas, *plot.field, layout);
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    drawSeries(canvas, plot.series[i], colourOf(plot, i), layout);
  }
  for (const Arrow& arrow : plot.arrows) drawArrow(canvas, arrow, layout);
  canvas.endClip();
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    drawMarkers(canvas, plot.series[i], colourOf(plot, i), layout);
  }
}

void drawPlaces(Canvas& canvas, const Plot& plot, const PlotLayout& layout) {
  for (const Place& place : plot.places) drawMarker(canvas, layout(place.at), place.marker, place.colour);
  for (const Place& place : plot.places) {
    drawBeside(canvas, layout(place.at), place.text, place.colour, layout.frame);
  }
}

void drawLabels(Canvas& canvas, const Plot& plot, const PlotLayout& layout) {
  for (const Label& label : plot.labels) {
    canvas.text(layout(label.at), label.text,
                {.size_px = label.size_px, .colour = label.colour, .across = Align::middle});
  }
}

void drawXAxis(Canvas& canvas, const Axis& axis, const PlotLayout& layout) {
  const Rect& frame = layout.frame;
  const double text_top = frame.bottom + kTickLength + 2.0;
  for (const Tick& tick : layout.x_ticks) {
    const double x = layout.x(tick.value);
    canvas.line({x, frame.bottom}, {x, frame.bottom + kTickLength}, {kInk, 0.8});
    canvas.text({x, text_top}, tick.text, {.across = Align::middle, .down = Align::start});
  }
  canvas.text({0.5 * (frame.left + frame.right), text_top + kLineHeight}, withUnit(axis.label, axis.unit),
              {.across = Align::middle, .down = Align::start});
}

void drawYAxis(Canvas& canvas, const Axis& axis, const PlotLayout& layout) {
  const Rect& frame = layout.frame;
  double left = frame.left - kTickLength - 3.0;
  for (const Tick& tick : layout.y_ticks) {
    const double y = layout.y(tick.value);
    canvas.line({frame.left - kTickLength, y}, {frame.left, y}, {kInk, 0.8});
    const TextStyle style{.across = Align::end};
    const Vec2 at(frame.left - kTickLength - 3.0, y);
    canvas.text(at, tick.text, style);
    left = std::min(left, canvas.textBox(at, tick.text, style).left);
  }
  canvas.text({left - kGap, 0.5 * (frame.top + frame.bottom)}, withUnit(axis.label, axis.unit),
              {.across = Align::middle, .down = Align::end, .upwards = true});
}

void drawAxes(Canvas& canvas, const Plot& plot, const PlotLayout& layout) {
  if (!plot.x.hidden || !plot.y.hidden) canvas.rectangle(layout.frame, Pen{kInk, 0.8}, std::nullopt);
  if (!plot.x.hidden) drawXAxis(canvas, plot.x, layout);
  if (!plot.y.hidden) drawYAxis(canvas, plot.y, layout);
}

}  // namespace

void drawPlot(Canvas& canvas, const Plot& plot, const Rect& panel) {
  const PlotLayout layout = computeLayout(plot, panel, canvas);
  canvas.text({0.5 * (panel.left + panel.right), panel.top}, plot.title, kPanelTitle);
  if (plot.field) drawField(canvas, *plot.field, layout);
  drawGrid(canvas, plot, layout);
  drawAxes(canvas, plot, layout);
  drawLayers(canvas, plot, layout);
  drawPlaces(canvas, plot, layout);
  drawLabels(canvas, plot, layout);
  if (plot.field) {
    drawColourBar(canvas, layout.colour_bar, plot.field->colours, layout.field_range, layout.colour_ticks,
                  withUnit(plot.field->label, plot.field->unit));
  }
  drawLegend(canvas, layout.legend, panel, layout.legend_top);
}

}  // namespace palpate::figures
