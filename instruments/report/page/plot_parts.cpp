#include "report/page/plot_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

namespace palpate::study {

namespace {

std::string csvCell(std::string text) {
  std::replace(text.begin(), text.end(), ',', ';');
  return text;
}

void addCurves(const figures::Plot& plot, int panel, std::string& csv) {
  for (const figures::Series& series : plot.series) {
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      csv += fmt::format("{},{},{:.9g},{:.9g},\n", panel, csvCell(series.name), series.x[i], series.y[i]);
    }
  }
}

void addField(const figures::Field& field, int panel, std::string& csv) {
  std::size_t next = 0;
  for (int row = 0; row < field.rows; ++row) {
    for (int column = 0; column < field.columns; ++column) {
      const double value = field.values[next++];
      if (!std::isfinite(value)) continue;
      csv += fmt::format("{},{},{:.9g},{:.9g},{:.9g}\n", panel, csvCell(field.label),
                         field.origin.x() + column * field.step.x(), field.origin.y() + row * field.step.y(), value);
    }
  }
}

}  // namespace

Plot mapPlane(const std::string& title) {
  Plot plot{.title = title};
  plot.equal_aspect = true;
  plot.x = {.label = "x", .unit = "mm"};
  plot.y = {.label = "y", .unit = "mm"};
  return plot;
}

figures::Axis thresholdAxis(const std::vector<Index>& thresholds, const std::vector<double>& ticks) {
  return {.label = "threshold: most triangles of a leaf",
          .scale = Scale::logarithmic,
          .from = static_cast<double>(thresholds.front()),
          .to = static_cast<double>(thresholds.back()),
          .ticks = ticksAt(ticks)};
}

figures::Shape verticalLine(const std::string& name, double x, double from, double to) {
  return {.name = name,
          .paths = {{Vec2(x, from), Vec2(x, to)}},
          .closed = false,
          .stroke = figures::Stroke::dotted,
          .width_px = 1.6};
}

figures::Series measuredSeries(const std::string& name, std::vector<double> x, std::vector<double> y,
                               figures::Marker marker) {
  return {.name = name, .x = std::move(x), .y = std::move(y), .marker = marker};
}

figures::Series dissertationSeries(const std::string& name, std::vector<double> x, std::vector<double> y,
                                   figures::Marker marker) {
  figures::Series series = measuredSeries(name, std::move(x), std::move(y), marker);
  series.stroke = figures::Stroke::dashed;
  return series;
}

std::vector<figures::Tick> ticksAt(const std::vector<double>& values) {
  std::vector<figures::Tick> ticks;
  for (const double value : values) {
    ticks.push_back({value, value >= 1.0 ? fmt::format("{:.0f}", value) : fmt::format("{:g}", value)});
  }
  return ticks;
}

std::vector<figures::Tick> fractionTicksAt(const std::vector<double>& shares) {
  std::vector<figures::Tick> ticks;
  for (const double share : shares) {
    const double inverse = 1.0 / share;
    const bool is_unit_fraction = inverse > 1.5 && std::abs(inverse - std::round(inverse)) < 1e-9;
    ticks.push_back({share, is_unit_fraction ? fmt::format("1/{:.0f}", inverse) : fmt::format("{:g}", share)});
  }
  return ticks;
}

std::string toCsv(const figures::Figure& figure) {
  std::string csv;
  int panel = 0;
  for (const figures::Panel& content : figure.panels) {
    ++panel;
    const auto* plot = std::get_if<figures::Plot>(&content);
    if (plot == nullptr) continue;
    addCurves(*plot, panel, csv);
    if (plot->field) addField(*plot->field, panel, csv);
  }
  return csv.empty() ? csv : std::string("panel,series,x,y,value\n").append(csv);
}

}  // namespace palpate::study
