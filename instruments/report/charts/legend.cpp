// Entries are set like words: as many in a row as fit, each row centred. plot_layout.h needs the number of rows before
// anything is drawn.
#include "report/charts/legend.h"

#include <algorithm>

#include "report/charts/lettering.h"
#include "report/charts/plot_layout.h"

namespace palpate::figures {

namespace {

constexpr double kSampleWidth = 26.0;
constexpr double kBetween = 18.0;

double entryWidth(const Canvas& canvas, const LegendEntry& entry) {
  return kSampleWidth + kGap + canvas.textBox({0.0, 0.0}, entry.name, {}).width();
}

struct Row {
  std::vector<const LegendEntry*> entries;
  double width = 0.0;
};

std::vector<Row> rowsOf(const Canvas& canvas, const std::vector<LegendEntry>& entries, double width) {
  std::vector<Row> rows;
  for (const LegendEntry& entry : entries) {
    const double needed = entryWidth(canvas, entry);
    if (rows.empty() || rows.back().width + kBetween + needed > width) rows.emplace_back();
    Row& row = rows.back();
    row.width += needed + (row.entries.empty() ? 0.0 : kBetween);
    row.entries.push_back(&entry);
  }
  return rows;
}

void drawSample(Canvas& canvas, const LegendEntry& entry, const Vec2& left) {
  const Vec2 right(left.x() + kSampleWidth, left.y());
  if (entry.filled) {
    canvas.rectangle({left.x(), left.y() - 5.0, right.x(), left.y() + 5.0}, std::nullopt, entry.colour);
    return;
  }
  if (entry.stroke != Stroke::none) canvas.line(left, right, {entry.colour, entry.width_px, entry.stroke});
  drawMarker(canvas, 0.5 * (left + right), entry.marker, entry.colour);
}

}  // namespace

Colour colourOf(const Plot& plot, std::size_t series) {
  return plot.series[series].colour.value_or(seriesColour(series));
}

std::vector<LegendEntry> legendEntries(const Plot& plot) {
  std::vector<LegendEntry> entries;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const Series& series = plot.series[i];
    if (series.name.empty()) continue;
    entries.push_back({series.name, series.stroke, series.marker, colourOf(plot, i), false, series.width_px});
  }
  for (const Shape& shape : plot.shapes) {
    if (shape.name.empty()) continue;
    const bool filled = shape.fill.has_value();
    entries.push_back(
        {shape.name, shape.stroke, Marker::none, filled ? *shape.fill : shape.colour, filled, shape.width_px});
  }
  return entries;
}

int legendRows(const Canvas& canvas, const std::vector<LegendEntry>& entries, double width) {
  return static_cast<int>(rowsOf(canvas, entries, width).size());
}

void drawLegend(Canvas& canvas, const std::vector<LegendEntry>& entries, const Rect& panel, double top) {
  double middle = top + 0.5 * kLineHeight;
  for (const Row& row : rowsOf(canvas, entries, panel.width())) {
    double left = 0.5 * (panel.left + panel.right - row.width);
    for (const LegendEntry* entry : row.entries) {
      drawSample(canvas, *entry, {left, middle});
      canvas.text({left + kSampleWidth + kGap, middle}, entry->name, {});
      left += entryWidth(canvas, *entry) + kBetween;
    }
    middle += kLineHeight;
  }
}

void drawColourBar(Canvas& canvas, const Rect& bar, ColourMap colours, const Range& range,
                   const std::vector<Tick>& ticks, const std::string& label) {
  constexpr int kSteps = 256;
  std::vector<std::uint32_t> pixels;
  pixels.reserve(kSteps);
  for (int i = 0; i < kSteps; ++i) pixels.push_back(toPremultipliedArgb(mapColour(colours, 1.0 - (i + 0.5) / kSteps)));
  canvas.image(bar, 1, kSteps, pixels);
  canvas.rectangle(bar, Pen{kInk, 0.8}, std::nullopt);
  const AxisMapping place{range, Scale::linear, bar.bottom, bar.top};
  double right = bar.right;
  for (const Tick& tick : ticks) {
    const double y = place(tick.value);
    canvas.line({bar.right, y}, {bar.right + 4.0, y}, {kInk, 0.8});
    const Vec2 at(bar.right + 4.0 + kGap, y);
    canvas.text(at, tick.text, {});
    right = std::max(right, canvas.textBox(at, tick.text, {}).right);
  }
  canvas.text({right + kGap, 0.5 * (bar.top + bar.bottom)}, label,
              {.across = Align::middle, .down = Align::start, .upwards = true});
}

}  // namespace palpate::figures
