// Figures 5.8 to 5.12: interpolated maps.
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "dissertation/figures/dissertation_figures.h"
#include "dissertation/numbers/table_5_1.h"
#include "lab/measured/model_meshes.h"
#include "lab/measured/pressed_skin.h"
#include "palpate/maps/ellipse_map.h"
#include "report/page/plot_parts.h"

namespace palpate::study {

namespace {

using figures::MeshView;

Plot squarePlot(const std::string& title) {
  Plot plot = mapPlane(title);
  plot.x.from = plot.y.from = -kTable51Half;
  plot.x.to = plot.y.to = kTable51Half;
  for (const maps::KeyPoint& key : table51Keys())
    plot.places.push_back({key.position_mm, fmt::format("O{}", key.name.substr(1))});
  return plot;
}

Figure figure58() {
  Plot plot = squarePlot("Table 5.1 in a square of 500 mm");
  int i = 0;
  for (const maps::KeyPoint& key : table51Keys()) {
    plot.shapes.push_back(
        {.name = key.name + ": 120 mm",
         .paths = {figures::ellipseOutline(key.position_mm, kTable51HalfMajor, kTable51HalfMajor, 0.0)},
         .colour = figures::seriesColour(static_cast<std::size_t>(i++)),
         .width_px = 1.8});
  }
  plot.shapes.push_back({.name = "basic circle: 90 mm",
                         .paths = {figures::ellipseOutline({-150.0, -150.0}, kTable51Basic, kTable51Basic, 0.0)},
                         .stroke = figures::Stroke::dashed});
  return {.panels = {plot}, .panel_height_px = 500.0};
}

using HalfMajor = double (*)(const Vec2& place, double effect_radius_mm);

Plot surfacePlot(const std::string& title, HalfMajor at) {
  Plot plot = squarePlot(title);
  figures::Field field{.origin = Vec2::Constant(-kTable51Half),
                       .step = Vec2::Constant(5.0),
                       .columns = 101,
                       .rows = 101,
                       .label = "half major axis",
                       .unit = "mm",
                       .from = kTable51Basic,
                       .to = kTable51HalfMajor};
  sampleField(field, [&](double x, double y) { return at({x, y}, 0.5 * kTable51Diameter); });
  field.contour_levels = {95, 100, 105, 110, 115};
  plot.field = field;
  return plot;
}

Series sectionSeries(const std::string& name, HalfMajor at, double effect_radius) {
  Series series{.name = name};
  for (double y = -kTable51Half; y <= kTable51Half; y += 2.5) {
    series.x.push_back(y);
    series.y.push_back(at({0.0, y}, effect_radius));
  }
  return series;
}

Figure surfaceFigure(const std::string& formula, HalfMajor at, const std::vector<double>& printed) {
  Plot section{.title = "Seen along x"};
  section.x = {.label = "y", .unit = "mm", .from = -kTable51Half, .to = kTable51Half};
  section.y = {.label = "half major axis on the y axis", .unit = "mm", .from = 85.0, .to = 125.0};
  section.series = {sectionSeries("effect radius 200 mm", at, 0.5 * kTable51Diameter),
                    sectionSeries("effect radius 400 mm", at, kTable51Diameter)};
  section.series[1].stroke = figures::Stroke::dotted;
  Series points{
      .name = "printed", .stroke = figures::Stroke::none, .marker = figures::Marker::diamond, .colour = figures::kInk};
  for (std::size_t i = 0; i < printed.size(); ++i) {
    points.x.push_back(kTable51Y[i]);
    points.y.push_back(printed[i]);
  }
  section.series.push_back(points);
  return {
      .panels = {surfacePlot(formula, at), section}, .columns = 2, .panel_width_px = 480.0, .panel_height_px = 400.0};
}

Figure figure59() { return surfaceFigure("(5.7): misses the keys", naiveHalfMajor, {115.0, 112.0}); }
Figure figure510() { return surfaceFigure("(5.16): exact at every key", exactHalfMajor, {120.0, 120.0, 120.0}); }

constexpr double kShownAround = 30.0;  // mm to both sides of the basic circle

Plot backMap(const maps::EllipseMap& map, double basic) {
  const std::vector<Vec2> outline = backOutline();
  Plot plot = mapPlane("Map with contour lines");
  figures::Field field{.origin = Vec2(-176.0, -208.0),
                       .step = Vec2::Constant(4.0),
                       .columns = 89,
                       .rows = 105,
                       .label = "half major axis",
                       .unit = "mm",
                       .from = basic - kShownAround,
                       .to = basic + kShownAround,
                       .colours = ColourMap::cool_warm};
  sampleField(field, [&](double x, double y) {
    return isInside(outline, {x, y}) ? map.at(x, y).half_major_mm : std::numeric_limits<double>::quiet_NaN();
  });
  field.contour_levels = {130, 140, 145, 150, 155, 160, 170};
  plot.field = field;
  plot.shapes.push_back({.paths = {outline}});
  for (const maps::KeyPoint& key : maps::dissertationKeyPoints()) plot.places.push_back({key.position_mm, key.name});
  return plot;
}

MeshView backView(const maps::EllipseMap& map, double basic) {
  const mesh::TriangleMesh back = backModel(20389);
  MeshView view{.title = "On the back"};
  view.positions = back.positions;
  view.triangles = back.triangles;
  view.towards_viewer = Vec3(0.25, -0.3, 1.0);
  view.ambient = 0.65;
  for (const Triangle& t : back.triangles) {
    const Vec3 middle = centreOf(back, t);
    const double share = 0.5 + 0.5 * (map.at(middle.x(), middle.y()).half_major_mm - basic) / kShownAround;
    view.colours.push_back(figures::mapColour(ColourMap::cool_warm, share));
  }
  for (const maps::KeyPoint& key : maps::dissertationKeyPoints()) {
    view.places.push_back({placeOn(back, key.position_mm).point, key.name});
  }
  return view;
}

Figure figure511() {
  const auto keys = maps::dissertationKeyPoints();
  const maps::EllipseMapSettings settings;
  const maps::EllipseMap map(keys, settings);
  return {.panels = {backView(map, settings.basic_radius_mm), backMap(map, settings.basic_radius_mm)},
          .columns = 2,
          .panel_width_px = 480.0,
          .panel_height_px = 520.0};
}

std::vector<std::array<Vec3, 2>> ellipseLoop(const Vec3& centre, const Vec3& along, const Vec3& across) {
  constexpr int kCorners = 96;
  std::vector<std::array<Vec3, 2>> loop;
  const auto corner = [&](int i) {
    const double angle = 2.0 * std::numbers::pi * i / kCorners;
    return Vec3(centre + std::cos(angle) * along + std::sin(angle) * across);
  };
  for (int i = 0; i < kCorners; ++i) loop.push_back({corner(i), corner(i + 1)});
  return loop;
}

// A map ellipse in space: its centre and its half axes.
struct Placed {
  Vec3 centre;
  Vec3 along;
  Vec3 across;
};

Placed placedOnMap(const maps::Ellipse& ellipse, const Vec3& centre) {
  const Vec3 unit(std::cos(ellipse.direction_rad), std::sin(ellipse.direction_rad), 0.0);
  const Vec3 along = ellipse.half_major_mm * unit;
  return {centre, along, ellipse.aspect * Vec3::UnitZ().cross(along)};
}

Placed placedOnSkin(const maps::Ellipse& ellipse, const SkinPlace& place) {
  const maps::SurfaceEllipse lifted = maps::liftedOntoSurface(ellipse, place.normal);
  return {place.point, lifted.half_major, lifted.aspect * place.normal.cross(lifted.half_major)};
}

std::vector<figures::Segments> projectionLines(const Placed& map, const Placed& skin) {
  const auto loop = [](const Placed& ellipse) { return ellipseLoop(ellipse.centre, ellipse.along, ellipse.across); };
  std::vector<figures::Segments> lines(4);
  lines[0] = {.name = "ellipse on the map", .segments = loop(map), .colour = figures::kBlue, .width_px = 1.8};
  lines[1] = {
      .name = "ellipse on the skin (E32)", .segments = loop(skin), .colour = figures::kVermilion, .width_px = 1.8};
  lines[2] = {.name = "projection along z", .segments = {{skin.centre, map.centre}}};
  lines[3] = {.name = "half major axes",
              .segments = {{skin.centre, skin.centre + skin.along}, {map.centre, map.centre + map.along}},
              .colour = figures::kGreen,
              .width_px = 2.0};
  for (figures::Segments& line : lines) line.on_top = true;
  return lines;
}

Figure figure512() {
  constexpr double kMapDistance = 170.0;  // mm, of the map plane in front of the back
  const mesh::TriangleMesh back = backModel();
  const SkinPlace place = placeOn(back, {100.0, -20.0});
  const maps::Ellipse ellipse{60.0, 0.7, 2.3};  // small, so that both are seen whole
  const Placed skin = placedOnSkin(ellipse, place);
  const Placed map = placedOnMap(ellipse, {place.point.x(), place.point.y(), kMapDistance});
  MeshView view;
  view.positions = back.positions;
  view.triangles = back.triangles;
  view.towards_viewer = Vec3(1.0, -0.55, 0.75);
  view.sheets.push_back({Vec3(-175.0, -200.0, kMapDistance), Vec3(350.0, 0.0, 0.0), Vec3(0.0, 400.0, 0.0),
                         figures::withAlpha(figures::kSky, 0.3)});
  view.lines = projectionLines(map, skin);
  view.places = {{skin.centre, "vertex"}, {map.centre, "P on the map"}};
  return {.panels = {view}, .panel_width_px = 620.0, .panel_height_px = 460.0};
}

}  // namespace

std::vector<DissertationFigure> mapFigures() {
  return {
      {"5.8", "Effect ellipses in a square area", "", figure58},
      {"5.9", "Interpolation by (5.7): the results do not fit the key points",
       "Colours instead of a surface in 3D. 115 and 112 need the effect radius 200: the printed 400 is the diameter "
       "(E28).",
       figure59},
      {"5.10", "Interpolation by (5.16): the results satisfy all key points", "Colours instead of a surface in 3D.",
       figure510},
      {"5.11", "Map of the half major axis on the back, from seven key points",
       "Our back; key places, basic circle (150 mm) and effect radius (200 mm) are assumed (E33). Blended as tensors "
       "(E29).",
       figure511, FigureBasis::own_example},
      {"5.12", "Projection from the model to the map plane and back",
       "The length of the axis is restored on the skin (E32).", figure512, FigureBasis::own_example}};
}

}  // namespace palpate::study
