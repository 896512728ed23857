// Table -> numbers for people.
#include "solve/realism/pressed_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace palpate::tissue {

namespace {

/// The first radius where the skin goes down no more than this share of the depth on the axis, straight between radii.
std::optional<double> radiusOfShare(const std::vector<double>& radii, const std::vector<double>& down, double share) {
  for (std::size_t i = 1; i < radii.size(); ++i) {
    if (down[i] > share) continue;
    const double along = (down[i - 1] - share) / (down[i - 1] - down[i]);
    return radii[i - 1] + along * (radii[i] - radii[i - 1]);
  }
  return std::nullopt;
}

double between(double a, double b, double share) { return a + share * (b - a); }

std::vector<double> between(const std::vector<double>& a, const std::vector<double>& b, double share) {
  std::vector<double> values(a.size());
  std::ranges::transform(a, b, values.begin(), [share](double x, double y) { return between(x, y, share); });
  return values;
}

}  // namespace

PressedNumbers numbersOf(const LayeredTable& table, const PressedShape& shape) {
  PressedNumbers numbers;
  numbers.secant_n_per_mm = shape.force_n / shape.depth_mm;
  numbers.half_radius_mm = radiusOfShare(table.radii_mm, shape.down, 0.5);
  numbers.tenth_radius_mm = radiusOfShare(table.radii_mm, shape.down, 0.1);
  numbers.bulge_mm = std::max(0.0, -*std::ranges::min_element(shape.down)) * shape.surface_mm;
  numbers.drawn_in_mm = std::max(0.0, -*std::ranges::min_element(shape.outward)) * shape.surface_mm;
  numbers.pushed_out_mm = std::max(0.0, *std::ranges::max_element(shape.outward)) * shape.surface_mm;
  return numbers;
}

PressedShape shapeAt(const LayeredTable& table, double depth_mm) {
  const auto& shapes = table.shapes;
  const auto deeper =
      std::ranges::find_if(shapes, [depth_mm](const PressedShape& shape) { return shape.depth_mm >= depth_mm; });
  if (deeper == shapes.begin()) return shapes.front();
  if (deeper == shapes.end()) return shapes.back();
  const PressedShape& a = *std::prev(deeper);
  const PressedShape& b = *deeper;
  const double share = (depth_mm - a.depth_mm) / (b.depth_mm - a.depth_mm);
  return {.depth_mm = depth_mm,
          .surface_mm = between(a.surface_mm, b.surface_mm, share),
          .force_n = between(a.force_n, b.force_n, share),
          .contact_radius_mm = between(a.contact_radius_mm, b.contact_radius_mm, share),
          .down = between(a.down, b.down, share),
          .outward = between(a.outward, b.outward, share)};
}

std::string formatStack(const LayerStack& stack) {
  if (stack.layers.empty()) return "layers unknown";
  std::string words;
  for (const Layer& layer : stack.layers) {
    words += fmt::format("{}{} x {}", words.empty() ? "" : " + ", layer.thickness_mm, layer.young_kpa);
  }
  return words;
}

}  // namespace palpate::tissue
