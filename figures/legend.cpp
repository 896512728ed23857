// The legend: samples of lines, markers and patches with their names, in centred rows.
#include "figures/legend.h"

#include <algorithm>
#include <array>

#include "figures/plot_layout.h"

namespace palpate::figures {

bool isFree(const Canvas& canvas, const Rect& box, const Rect& bounds) {
  constexpr double kMargin = 1.0;
  if (box.left < bounds.left || box.right > bounds.right || box.top < bounds.top || box.bottom > bounds.bottom) {
    return false;
  }
  for (const DrawnText& other : canvas.texts()) {
    if (box.left < other.right + kMargin && other.left < box.right + kMargin && box.top < other.bottom + kMargin &&
        other.top < box.bottom + kMargin) {
      return false;
    }
  }
  return true;
}

void drawBeside(Canvas& canvas, const Vec2& at, const std::string& text, const Colour& colour, const Rect& bounds) {
  struct Spot {
    Vec2 offset;
    Align across;
    Align down;
  };
  const std::array spots{
      Spot{{7.0, 0.0}, Align::start, Align::middle},   Spot{{-7.0, 0.0}, Align::end, Align::middle},
      Spot{{0.0, -6.0}, Align::middle, Align::end},    Spot{{0.0, 6.0}, Align::middle, Align::start},
      Spot{{7.0, -10.0}, Align::start, Align::middle}, Spot{{7.0, 10.0}, Align::start, Align::middle},
      Spot{{-7.0, -10.0}, Align::end, Align::middle},  Spot{{-7.0, 10.0}, Align::end, Align::middle},
      Spot{{9.0, -24.0}, Align::start, Align::middle}, Spot{{9.0, 24.0}, Align::start, Align::middle},
  };
  const auto style_at = [&](const Spot& spot) {
    return TextStyle{.size_px = 11.0, .colour = colour, .across = spot.across, .down = spot.down, .halo = true};
  };
  const Spot* chosen = spots.data();
  for (const Spot& spot : spots) {
    if (!isFree(canvas, canvas.textBox(at + spot.offset, text, style_at(spot)), bounds)) continue;
    chosen = &spot;
    break;
  }
  canvas.text(at + chosen->offset, text, style_at(*chosen));
}

namespace {

constexpr double kSampleWidth = 26.0;
constexpr double kBetween = 18.0;

double widthOf(const Canvas& canvas, const LegendEntry& entry) {
  return kSampleWidth + kGap + canvas.textBox({0.0, 0.0}, entry.name, {}).width();
}

struct Row {
  std::vector<const LegendEntry*> entries;
  double width = 0.0;
};

std::vector<Row> rowsOf(const Canvas& canvas, const std::vector<LegendEntry>& entries, double width) {
  std::vector<Row> rows;
  for (const LegendEntry& entry : entries) {
    const double needed = widthOf(canvas, entry);
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

std::vector<LegendEntry> legendOf(const Plot& plot) {
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
      left += widthOf(canvas, *entry) + kBetween;
    }
    middle += kLineHeight;
  }
}

}  // namespace palpate::figures
