// Figures 5.3 to 5.7: measured ellipses, the basic circle, the reach of a key point.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "dissertation/figures/dissertation_figures.h"
#include "dissertation/numbers/table_5_1.h"
#include "lab/measured/model_meshes.h"
#include "palpate/maps/ellipse_map.h"
#include "palpate/maps/gaussian_interpolation.h"
#include "palpate/maps/literal_interpolation.h"
#include "report/page/plot_parts.h"

namespace palpate::study {

namespace {

using figures::Shape;

Shape ellipseShape(const std::string& name, const Vec2& centre, const maps::Ellipse& ellipse,
                   const figures::Colour& colour) {
  return {.name = name,
          .paths = {figures::ellipseOutline(centre, ellipse.half_major_mm, ellipse.half_major_mm * ellipse.aspect,
                                            ellipse.direction_rad)},
          .colour = colour,
          .width_px = 1.8};
}

figures::Arrow halfMajor(const Vec2& centre, const maps::Ellipse& ellipse, const figures::Colour& colour) {
  const Vec2 along(std::cos(ellipse.direction_rad), std::sin(ellipse.direction_rad));
  return {centre, centre + ellipse.half_major_mm * along, colour, 1.4};
}

Figure figure53() {
  Plot plot = mapPlane("Means of the five subjects, dragged up");
  plot.shapes.push_back({.name = "our back", .paths = {backOutline()}, .colour = figures::kInk});
  const auto keys = maps::dissertationKeyPoints();
  for (std::size_t i = 0; i < 5; ++i) {
    const maps::KeyPoint& key = keys[i];
    const figures::Colour colour = figures::seriesColour(i);
    const std::string name =
        fmt::format("{}: 2l = {:.1f} cm, r = {:.2f}, d = {:.1f}\u00b0", key.name, 0.2 * key.ellipse.half_major_mm,
                    1.0 / key.ellipse.aspect, key.ellipse.direction_rad * kDegPerRad);
    plot.shapes.push_back(ellipseShape(name, key.position_mm, key.ellipse, colour));
    plot.arrows.push_back(halfMajor(key.position_mm, key.ellipse, colour));
    plot.places.push_back({key.position_mm, key.name, figures::Marker::circle, colour});
  }
  return {.panels = {plot}, .panel_width_px = 560.0, .panel_height_px = 660.0};
}

// The example of Figures 5.4 and 5.5: C between the near key A and the far key B.
struct EllipseExample {
  Vec2 c = Vec2(0.0, 0.0);
  double basic = 45.0;
  double effect_radius = 200.0;
  std::vector<maps::KeyPoint> keys;
};

EllipseExample example() {
  return {.keys = {{"A", Vec2(-55.0, 32.0), {75.0, 0.6, 2.1}, {}}, {"B", Vec2(225.0, -30.0), {60.0, 0.55, 0.5}, {}}}};
}

Plot keyPlot(const std::string& title, const EllipseExample& shown) {
  Plot plot = mapPlane(title);
  const maps::Ellipse circle{shown.basic, 1.0};
  plot.shapes = {ellipseShape("basic circle at C", shown.c, circle, figures::kBlue)};
  plot.arrows = {halfMajor(shown.c, circle, figures::kBlue)};
  plot.places = {{shown.c, "C"}};
  for (const maps::KeyPoint& key : shown.keys) {
    plot.shapes.push_back(ellipseShape("", key.position_mm, key.ellipse, figures::kInk));
    plot.arrows.push_back(halfMajor(key.position_mm, key.ellipse, figures::kInk));
    plot.places.push_back({key.position_mm, key.name});
  }
  plot.shapes.back().name = "key ellipses";
  return plot;
}

Figure figure54() { return {.panels = {keyPlot("Key ellipses over the basic circle", example())}}; }

Figure figure55() {
  const EllipseExample shown = example();
  Plot plot = keyPlot("The ellipse at C takes after A; B is too far", shown);
  const maps::EllipseMap map(shown.keys, {.effect_radius_mm = shown.effect_radius, .basic_radius_mm = shown.basic});
  const maps::Ellipse result = map.at(shown.c.x(), shown.c.y());
  plot.shapes.push_back(ellipseShape("ellipse at C", shown.c, result, figures::kVermilion));
  plot.arrows.push_back(halfMajor(shown.c, result, figures::kVermilion));
  plot.shapes.push_back({.name = "effect region",
                         .paths = {figures::ellipseOutline(shown.c, shown.effect_radius, shown.effect_radius, 0.0)},
                         .stroke = figures::Stroke::dashed,
                         .colour = figures::kGreen,
                         .width_px = 1.6});
  return {.panels = {plot}, .panel_height_px = 460.0};
}

// The distance, in effect radii, at which the level is `level`.
double distanceOfLevel(double level) { return std::sqrt(-std::log(level) / kGaussianRate); }

Figure figure56() {
  Plot plot{.title = "Effect levels of three key points at P"};
  plot.x = {.label = "distance from P over the effect radius", .from = -1.4, .to = 1.4};
  plot.y = {.label = "effect level a", .from = 0.0, .to = 1.1};
  figures::Series curve{.name = "a"};
  for (int i = -400; i <= 400; ++i) {
    curve.x.push_back(i / 400.0);
    curve.y.push_back(maps::effectLevel(std::abs(i) / 400.0, 1.0));
  }
  plot.series = {curve};
  plot.shapes = {{.name = "border of the effect region",
                  .paths = {{{-1, 0}, {-1, 1.1}}, {{1, 0}, {1, 1.1}}},
                  .closed = false,
                  .stroke = figures::Stroke::dashed,
                  .colour = figures::kGreen}};
  plot.places = {{Vec2(0.0, 1.0), "P"},
                 {Vec2(-distanceOfLevel(0.1), 0.1), "P1: a = 0.1"},
                 {Vec2(distanceOfLevel(0.5), 0.5), "P2: a = 0.5"},
                 {Vec2(1.2, 0.0), "P3: 0"}};
  return {.panels = {plot}};
}

Figure figure57() {
  Plot plot{.title = "Effect level from the array"};
  plot.x = {.label = "index in the array of 700 entries", .from = 0.0, .to = 699.0};
  plot.x.ticks = {{0, "0"},     {100, "100"}, {200, "200"}, {300, "300"},
                  {400, "400"}, {500, "500"}, {600, "600"}, {699, "699"}};
  plot.y = {.label = "effect level a", .from = 0.0, .to = 1.0};
  figures::Series curve{.name = "nearest entry"};
  for (int i = 0; i <= 699; ++i) {
    curve.x.push_back(i);
    curve.y.push_back(maps::tabulatedEffectLevel(i, 699.0));
  }
  plot.series = {curve};
  return {.panels = {plot}};
}

}  // namespace

std::vector<DissertationFigure> ellipseFigures() {
  return {{"5.3", "Deformation ellipses at the key points",
           "Our back's outline; where the points lie on it is assumed (E33). An axis of 180 degree is one of 0 (E29).",
           figure53, FigureBasis::printed},
          {"5.4", "Key deformation ellipses in the uniform deformation area", "Places and sizes are ours.", figure54,
           FigureBasis::own_example},
          {"5.5", "Effect region and the interpolated ellipse",
           "Places and sizes are ours; computed by the ellipse map.", figure55, FigureBasis::own_example},
          {"5.6", "The effect depends on the distance", "", figure56},
          {"5.7", "Gaussian curve mapping for the effect level", "", figure57}};
}

}  // namespace palpate::study
