// Depths are distinguished by the shade of an ordered colour map, stacks by colour and marker.
#include "solve/commands/layered_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "solve/realism/pressed_numbers.h"

namespace palpate::app {

namespace {

using figures::Plot;
using figures::Series;
using tissue::LayeredTable;
using tissue::PressedShape;

constexpr std::array kMarkers = {figures::Marker::circle, figures::Marker::square, figures::Marker::triangle,
                                 figures::Marker::diamond, figures::Marker::cross};

/// Look of the curves of one shape or one table.
struct Look {
  figures::Colour colour;
  figures::Marker marker = figures::Marker::circle;
  figures::Stroke stroke = figures::Stroke::solid;
};

Look lookOfTable(std::size_t i) {
  constexpr std::size_t kColours = 7;  // colours in seriesColour
  return {figures::seriesColour(i), kMarkers[i % kMarkers.size()],
          i < kColours ? figures::Stroke::solid : figures::Stroke::dashed};
}

/// A shape that is drawn.
struct Drawn {
  std::string name;
  const LayeredTable* table = nullptr;
  PressedShape shape;
  Look look;
};

Series makeSeries(const Drawn& drawn, const std::vector<double>& shares, double sign, double to_radius_mm) {
  Series curve{.name = drawn.name, .stroke = drawn.look.stroke, .colour = drawn.look.colour};
  for (std::size_t i = 0; i < shares.size() && drawn.table->radii_mm[i] <= to_radius_mm; ++i) {
    curve.x.push_back(drawn.table->radii_mm[i]);
    curve.y.push_back(sign * drawn.shape.surface_mm * shares[i]);
  }
  return curve;
}

Plot shapePanel(Plot plot, const std::vector<Drawn>& drawn, std::vector<double> PressedShape::*shares, double sign,
                double to_radius_mm) {
  for (const Drawn& one : drawn) plot.series.push_back(makeSeries(one, one.shape.*shares, sign, to_radius_mm));
  return plot;
}

/// One curve a table over depth, from the origin where the quantity is 0 there.
template <class Value>
Plot depthPanel(const std::vector<NamedTable>& tables, const std::string& title, const figures::Axis& y,
                bool from_origin, const Value& value) {
  Plot plot{.title = title, .x = {.label = "depth", .unit = "mm"}, .y = y};
  plot.x.from = 0.0;
  plot.y.from = 0.0;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const Look look = lookOfTable(i);
    Series curve{.name = tables.size() > 1 ? tables[i].name : "",
                 .stroke = look.stroke,
                 .marker = look.marker,
                 .colour = look.colour};
    if (from_origin) {
      curve.x.push_back(0.0);
      curve.y.push_back(0.0);
    }
    for (const PressedShape& shape : tables[i].table.shapes) {
      curve.x.push_back(shape.depth_mm);
      curve.y.push_back(value(tables[i].table, shape));
    }
    plot.series.push_back(std::move(curve));
  }
  return plot;
}

Plot forcePanel(const std::vector<NamedTable>& tables) {
  return depthPanel(tables, "force", {.label = "force", .unit = "N"}, true,
                    [](const LayeredTable&, const PressedShape& shape) { return shape.force_n; });
}

Plot widthPanel(const std::vector<NamedTable>& tables) {
  return depthPanel(tables, "width of the dent", {.label = "radius of half the depth", .unit = "mm"}, false,
                    [](const LayeredTable& table, const PressedShape& shape) {
                      return tissue::numbersOf(table, shape).half_radius_mm.value_or(table.radii_mm.back());
                    });
}

/// The deepest that all tables reach.
double sharedDepth(const std::vector<NamedTable>& tables) {
  double depth = tables.front().table.shapes.back().depth_mm;
  for (const NamedTable& one : tables) depth = std::min(depth, one.table.shapes.back().depth_mm);
  return depth;
}

std::vector<Drawn> listDrawnShapes(const std::vector<NamedTable>& tables, const LayeredFigureSettings& settings) {
  std::vector<Drawn> drawn;
  if (tables.size() == 1 && !settings.depth_mm) {
    const LayeredTable& table = tables.front().table;
    for (std::size_t i = 0; i < table.shapes.size(); ++i) {
      const PressedShape& shape = table.shapes[i];
      drawn.push_back({fmt::format("{:.4g} mm", shape.depth_mm), &table, shape, {depthColour(i, table.shapes.size())}});
    }
    return drawn;
  }
  const double depth = settings.depth_mm.value_or(sharedDepth(tables));
  for (std::size_t i = 0; i < tables.size(); ++i) {
    drawn.push_back({tables[i].name, &tables[i].table, shapeAt(tables[i].table, depth), lookOfTable(i)});
  }
  return drawn;
}

std::string makeFigureNote(const std::vector<NamedTable>& tables, const std::vector<Drawn>& drawn) {
  const LayeredTable& first = tables.front().table;
  std::string note = fmt::format("A rigid sphere of {:.4g} mm.", first.indenter_radius_mm);
  if (tables.size() > 1) {
    note += fmt::format(" The skin at {:.4g} mm.", drawn.front().shape.depth_mm);
    for (const NamedTable& one : tables) note += fmt::format(" {}: {}.", one.name, formatStack(one.table.stack));
  } else {
    note += fmt::format(" Layers: {}.", formatStack(first.stack));
  }
  return note + " Layers are thickness in mm x Young's modulus in kPa, from the skin down to bone.";
}

}  // namespace

Plot skinDownPlot() {
  return {.title = "the skin goes down",
          .x = {.label = "distance from the axis at rest", .unit = "mm"},
          .y = {.label = "height of the skin", .unit = "mm"}};
}

Plot skinSidewaysPlot() {
  return {.title = "the skin goes sideways",
          .x = {.label = "distance from the axis at rest", .unit = "mm"},
          .y = {.label = "away from the axis", .unit = "mm"}};
}

figures::Colour depthColour(std::size_t i, std::size_t count) {
  constexpr double kLightest = 0.85;
  const double share = count < 2 ? 0.0 : static_cast<double>(i) / static_cast<double>(count - 1);
  return figures::mapColour(ColourMap::viridis, kLightest * share);
}

figures::Figure layeredFigure(const std::vector<NamedTable>& tables, const LayeredFigureSettings& settings) {
  const std::vector<Drawn> drawn = listDrawnShapes(tables, settings);
  figures::Figure figure;
  figure.title = settings.title;
  figure.columns = 2;
  figure.panels = {shapePanel(skinDownPlot(), drawn, &PressedShape::down, -1.0, settings.to_radius_mm),
                   shapePanel(skinSidewaysPlot(), drawn, &PressedShape::outward, 1.0, settings.to_radius_mm),
                   forcePanel(tables), widthPanel(tables)};
  figure.note = makeFigureNote(tables, drawn);
  return figure;
}

}  // namespace palpate::app
