// A grid over the outline's box, empty outside; places come in pairs of mirror images, to measure symmetry.
#include "lab/measured/back_map.h"

#include <cmath>
#include <limits>

#include "lab/measured/model_meshes.h"

namespace palpate::study {

namespace {

Eigen::AlignedBox2d outlineBox(const std::vector<Vec2>& outline) {
  Eigen::AlignedBox2d box;
  for (const Vec2& corner : outline) box.extend(corner);
  return box;
}

figures::Field fieldOver(const std::vector<Vec2>& outline, const MapValue& value, const MapLook& look, double step_mm) {
  const Eigen::AlignedBox2d box = outlineBox(outline);
  figures::Field field{.origin = box.min(),
                       .step = Vec2::Constant(step_mm),
                       .columns = static_cast<int>(box.sizes().x() / step_mm) + 2,
                       .rows = static_cast<int>(box.sizes().y() / step_mm) + 2,
                       .label = look.label,
                       .unit = look.unit,
                       .from = look.from,
                       .to = look.to,
                       .colours = look.colours,
                       .contour_levels = look.contour_levels};
  sampleField(field, [&](double x, double y) {
    return isInside(outline, {x, y}) ? value({x, y}) : std::numeric_limits<double>::quiet_NaN();
  });
  return field;
}

}  // namespace

figures::Plot backMap(const std::string& title, const MapValue& value, const MapLook& look,
                      std::span<const maps::KeyPoint> keys, double step_mm) {
  const std::vector<Vec2> outline = backOutline();
  figures::Plot plot{.title = title};
  plot.equal_aspect = true;
  plot.x = {.label = "x", .unit = "mm"};
  plot.y = {.label = "y", .unit = "mm"};
  plot.field = fieldOver(outline, value, look, step_mm);
  plot.shapes.push_back({.paths = {outline}});
  for (const maps::KeyPoint& key : keys) plot.places.push_back({key.position_mm, key.name});
  return plot;
}

std::vector<Vec2> placesOnBack(double step_mm) {
  const std::vector<Vec2> outline = backOutline();
  const Eigen::AlignedBox2d box = outlineBox(outline);
  std::vector<Vec2> places;
  const int half_columns = static_cast<int>(std::ceil(box.sizes().x() / step_mm));
  for (double y = box.min().y(); y <= box.max().y(); y += step_mm) {
    for (int column = -half_columns; column < half_columns; ++column) {
      const Vec2 place((column + 0.5) * step_mm, y);
      if (isInside(outline, place) && isInside(outline, {-place.x(), y})) places.push_back(place);
    }
  }
  return places;
}

}  // namespace palpate::study
