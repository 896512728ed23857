#include "study/plot_parts.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace palpate::study {

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

figures::Series printedSeries(const std::string& name, std::vector<double> x, std::vector<double> y,
                              figures::Marker marker) {
  figures::Series series = measuredSeries(name, std::move(x), std::move(y), marker);
  series.stroke = figures::Stroke::dashed;
  return series;
}

std::vector<figures::Tick> ticksAt(const std::vector<double>& values) {
  std::vector<figures::Tick> ticks;
  for (const double value : values) {
    const bool unit_fraction = value < 1.0 && std::abs(1.0 / value - std::round(1.0 / value)) < 1e-9;
    ticks.push_back({value, unit_fraction ? fmt::format("1/{:.0f}", 1.0 / value) : fmt::format("{:g}", value)});
  }
  return ticks;
}

}  // namespace palpate::study
