// Means as a table of key points, and the words for ways of pulling.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "palpate/base/text.h"
#include "palpate/measure/average.h"

namespace palpate::measure {

namespace {

struct DragWord {
  std::string_view word;
  double degrees;
};
constexpr std::array kDragWords = {DragWord{"right", 0.0},  DragWord{"up and right", 45.0},
                                   DragWord{"up", 90.0},    DragWord{"up and left", 135.0},
                                   DragWord{"left", 180.0}, DragWord{"down and left", -135.0},
                                   DragWord{"down", -90.0}, DragWord{"down and right", -45.0}};

std::string optionalField(const std::optional<double>& number) { return number ? fmt::format("{:.6g}", *number) : ""; }
std::string errorField(double sd) { return std::isfinite(sd) ? fmt::format("{:.4g}", sd) : ""; }

/// Ten digits: values printed with fewer are read back unchanged.
std::string formatRow(const std::string& name, const PointMean& point, const MeanEllipse& mean,
                      const std::optional<double>& drag_deg) {
  return fmt::format("{},{:.10g},{:.10g},{:.10g},{:.10g},{:.10g},{},{},{},{},{},{},{}\n", name, point.place_mm.x(),
                     point.place_mm.y(), mean.half_major_mm.value, mean.major_over_minor.value,
                     mean.direction_deg.value, optionalField(point.stiffness_n_per_mm),
                     optionalField(point.half_major_4_mm), optionalField(point.peak_mm), optionalField(drag_deg),
                     errorField(mean.half_major_mm.sd), errorField(mean.major_over_minor.sd),
                     errorField(mean.direction_deg.sd));
}

}  // namespace

std::string keyPointTable(const Averages& averages, bool by_drag) {
  std::string table =
      "name,x_mm,y_mm,half_major_mm,major_over_minor,direction_deg,stiffness_n_per_mm,half_major_4_mm,peak_mm,drag_deg,"
      "sd_half_major_mm,sd_ratio,sd_direction_deg\n";
  for (const PointMean& point : averages.points) {
    if (!by_drag) {
      const bool one = point.drags.size() == 1;
      table += formatRow(point.name, point, point.mean, one ? point.drags.front().drag_deg : std::nullopt);
      continue;
    }
    for (const DragMean& drag : point.drags) {
      const std::string way = drag.drag_deg ? fmt::format(" {}", dragDirectionName(*drag.drag_deg)) : std::string();
      table += formatRow(point.name + way, point, drag.mean, drag.drag_deg);
    }
  }
  return table;
}

std::string dragDirectionName(double drag_deg) {
  constexpr double kNearDeg = 22.5;
  for (const DragWord& drag : kDragWords) {
    if (std::abs(std::remainder(drag_deg - drag.degrees, 360.0)) <= kNearDeg) return std::string(drag.word);
  }
  return fmt::format("{:.0f} degrees", drag_deg);
}

std::optional<double> dragNamed(std::string_view words) {
  for (const DragWord& drag : kDragWords) {
    if (drag.word == words) return drag.degrees;
  }
  const auto number = parseNumber(words);
  if (!number || !(std::abs(*number) <= 360.0)) return std::nullopt;
  return std::remainder(*number, 360.0);
}

}  // namespace palpate::measure
