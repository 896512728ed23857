#include "dissertation/interpolation/interpolation_findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "dissertation/interpolation/left_out.h"
#include "dissertation/numbers/table_5_1.h"
#include "lab/measured/back_map.h"
#include "palpate/maps/ellipse_map.h"
#include "report/page/plot_parts.h"

namespace palpate::study {

namespace {

using figures::MeshView;

using HalfMajor = double (*)(const Vec2& place, double effect_radius_mm);

constexpr std::array kRadii{100.0, 200.0, 400.0};  // the printed 400 as diameter is the one in the middle (E28)
// (5.7) at E1 and E2 as printed.
constexpr double kPrintedE1 = 115.0;
constexpr double kPrintedE2 = 112.0;

// A surface of the half major axis over the square of Table 5.1, as Figures 5.9 and 5.10 show it.
MeshView surfaceView(const std::string& title, HalfMajor at, double radius, int cells) {
  constexpr double kStretch = 5.0;  // 30 mm over 500 mm are hardly seen
  MeshView view{.title = title};
  view.towards_viewer = Vec3(1.0, -0.55, 0.6);
  view.up = Vec3::UnitZ();
  view.ambient = 0.55;
  view.scale_bar = false;
  const double step = kTable51Square / cells;
  for (int row = 0; row <= cells; ++row) {
    for (int column = 0; column <= cells; ++column) {
      const Vec2 place(column * step - kTable51Half, row * step - kTable51Half);
      view.positions.emplace_back(place.x(), place.y(), kStretch * (at(place, radius) - kTable51Basic));
    }
  }
  const auto corner = [cells](int row, int column) { return static_cast<Index>(row * (cells + 1) + column); };
  const double highest = kStretch * (kTable51HalfMajor - kTable51Basic);
  for (int row = 0; row < cells; ++row) {
    for (int column = 0; column < cells; ++column) {
      for (const Triangle& t : {Triangle{corner(row, column), corner(row, column + 1), corner(row + 1, column + 1)},
                                Triangle{corner(row, column), corner(row + 1, column + 1), corner(row + 1, column)}}) {
        const double height = (view.positions[t[0]].z() + view.positions[t[1]].z() + view.positions[t[2]].z()) / 3.0;
        view.triangles.push_back(t);
        view.colours.push_back(figures::mapColour(ColourMap::viridis, height / highest));
      }
    }
  }
  for (const maps::KeyPoint& key : table51Keys()) {
    const double height = kStretch * (at(key.position_mm, radius) - kTable51Basic);
    view.places.push_back({{key.position_mm.x(), key.position_mm.y(), height}, key.name});
  }
  return view;
}

Plot sectionPlot(const std::string& title, HalfMajor at) {
  Plot plot{.title = title};
  plot.x = {.label = "y", .unit = "mm", .from = -kTable51Half, .to = kTable51Half};
  plot.y = {.label = "half major axis at x = 0", .unit = "mm", .from = 85.0, .to = 125.0};
  for (const double radius : {100.0, 150.0, 200.0, 300.0, 400.0}) {
    Series series{.name = fmt::format("e = {} mm", radius)};
    if (radius == 200.0) series.width_px = 3.0;
    for (double y = -kTable51Half; y <= kTable51Half; y += 2.5) {
      series.x.push_back(y);
      series.y.push_back(at({0.0, y}, radius));
    }
    plot.series.push_back(series);
  }
  return plot;
}

void addPrinted(const std::vector<double>& values, Plot& plot) {
  Series printed{.name = "printed", .stroke = Stroke::none, .marker = Marker::diamond, .colour = figures::kInk};
  for (std::size_t i = 0; i < values.size(); ++i) {
    printed.x.push_back(kTable51Y[i]);
    printed.y.push_back(values[i]);
  }
  plot.series.push_back(printed);
}

double naiveAtKey(std::size_t key, double radius) { return naiveHalfMajor({0.0, kTable51Y[key]}, radius); }

Series printedLevel(const std::string& name, double value, const figures::Colour& colour) {
  return {.name = name,
          .x = {60.0, 500.0},
          .y = {value, value},
          .stroke = Stroke::dotted,
          .colour = colour,
          .width_px = 1.4};
}

Plot radiusPlot() {
  Plot plot{.title = "(5.7) at the keys"};
  plot.x = {.label = "effect radius e", .unit = "mm", .from = 60.0, .to = 500.0};
  plot.y = {.label = "half major axis", .unit = "mm", .from = 110.0, .to = 121.0};
  for (const std::size_t key : {0u, 1u}) {
    Series series{.name = fmt::format("R(E{})", key + 1)};
    for (double radius = 60.0; radius <= 500.0; radius += 4.0) {
      series.x.push_back(radius);
      series.y.push_back(naiveAtKey(key, radius));
    }
    plot.series.push_back(series);
  }
  plot.series.push_back(printedLevel("printed 115", kPrintedE1, figures::seriesColour(0)));
  plot.series.push_back(printedLevel("printed 112", kPrintedE2, figures::seriesColour(1)));
  const RadiusRange fitting = radiiOfFigure59();
  plot.shapes.push_back({.name = "both as printed",
                         .paths = {figures::rectangleOutline({fitting.from, 110.0}, {fitting.to, 121.0})},
                         .stroke = Stroke::none,
                         .fill = figures::withAlpha(figures::kGreen, 0.18)});
  return plot;
}

constexpr double kBasic = 150.0;         // mm, of the back (E33)
constexpr double kColoursAround = 30.0;  // mm to both sides
// Thin plates and planes run away.
constexpr double kShownFarAround = 90.0;

MapLook halfMajorLook(double around) {
  MapLook look{.label = "half major axis",
               .unit = "mm",
               .from = kBasic - around,
               .to = kBasic + around,
               .colours = ColourMap::cool_warm};
  for (double away = -around + around / 3.0; away < around; away += around / 3.0) {
    look.contour_levels.push_back(kBasic + away);
  }
  return look;
}

Plot halfMajorMap(const std::string& title, const TensorField& field, double step_mm, double around = kColoursAround) {
  return backMap(
      title, [&](const Vec2& place) { return maps::ellipseOf(field(place)).half_major_mm; }, halfMajorLook(around),
      maps::dissertationKeyPoints(), step_mm);
}

Figure threeMaps(std::vector<figures::Panel> panels) {
  return {.panels = std::move(panels), .columns = 3, .panel_width_px = 400.0, .panel_height_px = 390.0};
}

// Ellipses at a tenth of their size, over the back.
figures::Shape ellipseGlyphs(const TensorField& field) {
  constexpr double kGrid = 40.0;
  constexpr double kShare = 0.1;
  figures::Shape glyphs{.colour = figures::kInk, .width_px = 1.0};
  for (const Vec2& place : placesOnBack(kGrid)) {
    const maps::Ellipse ellipse = maps::ellipseOf(field(place));
    glyphs.paths.push_back(figures::ellipseOutline(
        place, kShare * ellipse.half_major_mm, kShare * ellipse.half_major_mm * ellipse.aspect, ellipse.direction_rad));
  }
  return glyphs;
}

TensorField meanGriField(maps::ForceDirection force) {
  return *fieldThrough(meanSet(force), Interpolator::gri, maps::EllipseMapSettings{}.effect_radius_mm);
}

}  // namespace

RadiusRange radiiOfFigure59() {
  RadiusRange range;
  for (double radius = 60.0; radius <= 500.0; radius += 0.5) {
    const bool both =
        std::round(naiveAtKey(0, radius)) == kPrintedE1 && std::round(naiveAtKey(1, radius)) == kPrintedE2;
    if (both && range.from == 0.0) range.from = radius;
    if (both) range.to = radius;
  }
  return range;
}

Figure widthSurfaces(int cells) {
  Figure figure{.columns = 3, .panel_width_px = 400.0, .panel_height_px = 250.0};
  for (const double radius : kRadii) {
    figure.panels.emplace_back(surfaceView(fmt::format("(5.7), e = {} mm", radius), naiveHalfMajor, radius, cells));
  }
  for (const double radius : kRadii) {
    figure.panels.emplace_back(surfaceView(fmt::format("(5.16), e = {} mm", radius), exactHalfMajor, radius, cells));
  }
  figure.note =
      "Half major axis over the square of 500 mm of Table 5.1, from 90 mm (dark) to 120 mm (bright), five times "
      "enlarged.";
  return figure;
}

Figure widthSections() {
  Plot naive = sectionPlot("(5.7): Figure 5.9", naiveHalfMajor);
  addPrinted({kPrintedE1, kPrintedE2}, naive);
  Plot exact = sectionPlot("(5.16): Figure 5.10", exactHalfMajor);
  addPrinted({kTable51HalfMajor, kTable51HalfMajor, kTable51HalfMajor}, exact);
  return {.panels = {naive, exact, radiusPlot()}, .columns = 3, .panel_width_px = 400.0, .panel_height_px = 380.0};
}

Figure backOverWidths(double step_mm) {
  std::vector<figures::Panel> panels;
  for (const double radius : kRadii) {
    const TensorField field = *fieldThrough(meanSet(maps::ForceDirection::up), Interpolator::gri, radius);
    panels.emplace_back(halfMajorMap(fmt::format("Effect radius {} mm", radius), field, step_mm));
  }
  return threeMaps(std::move(panels));
}

Figure interpolatorMapFigure(double step_mm) {
  const TensorSet keys = meanSet(maps::ForceDirection::up);
  std::vector<figures::Panel> panels;
  for (const auto& [title, interpolator] :
       {std::pair{"GRI, 200 mm", Interpolator::gri}, std::pair{"Thin plate", Interpolator::thin_plate},
        std::pair{"Plane", Interpolator::plane}}) {
    panels.emplace_back(halfMajorMap(title, *fieldThrough(keys, interpolator, 200.0), step_mm, kShownFarAround));
  }
  return threeMaps(std::move(panels));
}

Figure upAndDown(double step_mm) {
  const TensorField up = meanGriField(maps::ForceDirection::up);
  const TensorField down = meanGriField(maps::ForceDirection::down);
  Plot up_map = halfMajorMap("Dragged up, five subjects", up, step_mm);
  Plot down_map = halfMajorMap("Dragged down, three subjects", down, step_mm);
  up_map.shapes.push_back(ellipseGlyphs(up));
  down_map.shapes.push_back(ellipseGlyphs(down));
  for (Plot* plot : {&up_map, &down_map}) plot->field->contour_levels.clear();
  const MapLook look{
      .label = "boundary, down against up", .unit = "mm rms", .to = 50.0, .contour_levels = {10, 20, 30, 40}};
  const Plot difference = backMap(
      "How far they are apart", [&](const Vec2& place) { return boundaryRmsMm(up(place), down(place)); }, look,
      maps::dissertationKeyPoints(), step_mm);
  return threeMaps({up_map, down_map, difference});
}

}  // namespace palpate::study
