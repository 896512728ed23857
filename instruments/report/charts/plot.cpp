// Outlines as polygons: an ellipse has 128 corners.
#include "report/charts/plot.h"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace palpate::figures {

std::vector<Vec2> ellipseOutline(const Vec2& centre, double half_along, double half_across, double direction_rad) {
  constexpr int kCorners = 128;
  const Vec2 along(std::cos(direction_rad), std::sin(direction_rad));
  const Vec2 across(-along.y(), along.x());
  std::vector<Vec2> outline;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCorners;
    outline.emplace_back(centre + half_along * std::cos(angle) * along + half_across * std::sin(angle) * across);
  }
  return outline;
}

std::vector<Vec2> rectangleOutline(const Vec2& low, const Vec2& high) {
  return {low, Vec2(high.x(), low.y()), high, Vec2(low.x(), high.y())};
}

Shape bars(const std::string& name, const std::vector<double>& centres, const std::vector<double>& heights,
           double width, const Colour& colour) {
  Shape shape{.name = name, .stroke = Stroke::none, .colour = colour, .fill = colour};
  for (std::size_t i = 0; i < centres.size(); ++i) {
    shape.paths.push_back(
        rectangleOutline(Vec2(centres[i] - 0.5 * width, 0.0), Vec2(centres[i] + 0.5 * width, heights[i])));
  }
  return shape;
}

}  // namespace palpate::figures
