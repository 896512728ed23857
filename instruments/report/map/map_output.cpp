#include "report/map/map_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include "palpate/base/error.h"
#include "palpate/base/text.h"
#include "palpate/mesh/files/save.h"
#include "report/charts/figure.h"
#include "report/charts/ticks.h"

namespace palpate::app {

namespace {

constexpr std::array<std::string_view, 4> kExtensions{".csv", ".ply", ".png", ".svg"};
/// Pictures sample the plane this often along its longer side; directions more often, because between 179 and 1 degree
/// a picture shows the colours in between, in a line as wide as the sampling.
constexpr double kPictureNodes = 600.0;
constexpr double kDirectionNodes = 1500.0;
/// Distance of the strokes that show directions.
constexpr double kStrokeStepMm = 20.0;
/// Key outlines are drawn this much smaller: the measured ones are as large as the back and would hide each other.
constexpr double kOutlineScale = 0.2;
/// Contour lines of a picture, about.
constexpr int kContourLines = 8;

void appendCsvRow(std::string& text, const std::vector<double>& numbers) {
  fmt::format_to(std::back_inserter(text), "{}\n", fmt::join(numbers, ","));
}

std::string csvOfVertices(const MapSkin& skin, const SkinMap& map) {
  std::string text = "vertex,x_mm,y_mm,z_mm";
  for (const MapColumn& column : map.vertices) text += "," + column.name;
  text += '\n';
  for (std::size_t v = 0; v < skin.mesh.positions.size(); ++v) {
    const Vec3& p = skin.mesh.positions[v];
    std::vector<double> row{static_cast<double>(v), p.x(), p.y(), p.z()};
    for (const MapColumn& column : map.vertices) row.push_back(column.values[v]);
    appendCsvRow(text, row);
  }
  return text;
}

/// The map's numbers at a node on the skin.
std::vector<double> rowAt(const MapSkin& skin, const SkinMap& map, const SkinGrid& grid, std::size_t node) {
  if (map.plane) return map.plane(grid.node(node));
  return {valueAt(skin.mesh, grid.spots[node], columnOf(map, map.shown.column))};
}

std::string csvOfGrid(const MapSkin& skin, const SkinMap& map, double step_mm) {
  const SkinGrid grid = gridOver(skin.mesh, step_mm);
  std::string text = fmt::format("x_mm,y_mm,{}\n", fmt::join(map.plane_columns, ","));
  for (std::size_t i = 0; i < grid.spots.size(); ++i) {
    if (grid.spots[i].triangle == kNoIndex) continue;
    const Vec2 place = grid.node(i);
    std::vector<double> row = rowAt(skin, map, grid, i);
    row.insert(row.begin(), {place.x(), place.y()});
    appendCsvRow(text, row);
  }
  return text;
}

double rangeFraction(double value, const std::pair<double, double>& range) {
  return range.second > range.first ? (value - range.first) / (range.second - range.first) : 0.5;
}

void writePly(const std::filesystem::path& file, const MapSkin& skin, const SkinMap& map) {
  const std::pair<double, double> range = shownRange(map);
  mesh::VertexChannels channels;
  for (const MapColumn& column : map.vertices) {
    channels.scalars.push_back({column.name, {column.values.begin(), column.values.end()}});
  }
  for (const double value : columnOf(map, map.shown.column)) {
    channels.colours.push_back(bytesOf(colourOf(map.shown.colours, rangeFraction(value, range))));
  }
  mesh::save(file, skin.mesh, channels);
}

// ---- pictures

std::vector<double> contourLevels(const std::pair<double, double>& range) {
  std::vector<double> levels;
  for (const figures::Tick& tick :
       figures::niceTicks({range.first, range.second}, figures::Scale::linear, kContourLines)) {
    levels.push_back(tick.value);
  }
  return levels;
}

figures::Field makeMapField(const MapSkin& skin, const SkinMap& map) {
  const double longer_mm = mesh::boundingBox(skin.mesh).sizes().head<2>().maxCoeff();
  const SkinGrid grid = gridOver(skin.mesh, longer_mm / (map.shown.directions ? kDirectionNodes : kPictureNodes));
  const auto named = std::find(map.plane_columns.begin(), map.plane_columns.end(), map.shown.column);
  const auto column = static_cast<std::size_t>(named - map.plane_columns.begin());
  const std::pair<double, double> range = shownRange(map);
  figures::Field field;
  field.origin = grid.origin;
  field.step = Vec2::Constant(grid.step_mm);
  field.columns = grid.columns;
  field.rows = grid.rows;
  field.label = map.shown.label;
  field.unit = map.shown.unit;
  field.from = range.first;
  field.to = range.second;
  field.colours = map.shown.colours;
  if (!map.shown.directions) field.contour_levels = contourLevels(range);
  for (std::size_t i = 0; i < grid.spots.size(); ++i) {
    const bool beside = grid.spots[i].triangle == kNoIndex;
    field.values.push_back(beside ? std::numeric_limits<double>::quiet_NaN() : rowAt(skin, map, grid, i)[column]);
  }
  return field;
}

/// Short strokes along the directions.
figures::Shape directionStrokes(const figures::Field& field) {
  const int every = std::max(1, static_cast<int>(kStrokeStepMm / field.step.x()));
  const double half_mm = 0.35 * kStrokeStepMm;
  figures::Shape strokes;
  strokes.name = "major axis";
  strokes.closed = false;
  for (int row = every / 2; row < field.rows; row += every) {
    for (int column = every / 2; column < field.columns; column += every) {
      const double degree = field.values[static_cast<std::size_t>(row) * field.columns + column];
      if (std::isnan(degree)) continue;
      const Vec2 at = field.origin + field.step.cwiseProduct(Vec2(column, row));
      const double angle = degree * std::numbers::pi / 180.0;
      const Vec2 along = half_mm * Vec2(std::cos(angle), std::sin(angle));
      strokes.paths.push_back({at - along, at + along});
    }
  }
  return strokes;
}

figures::Shape keyPointOutlines(const std::vector<MapKey>& keys) {
  figures::Shape outlines;
  outlines.name = "key points' boundaries, a fifth of their size";
  for (const MapKey& key : keys) {
    if (key.outline.empty()) continue;
    outlines.paths.push_back(key.outline);
    for (Vec2& p : outlines.paths.back()) p = key.at + kOutlineScale * (p - key.at);
  }
  return outlines;
}

/// Their outlines in true size, and in the middle of each what it changes.
void addDysfunctions(const std::vector<MapKey>& dysfunctions, figures::Plot& plot) {
  if (dysfunctions.empty()) return;
  figures::Shape rings{.name = "dysfunctions", .stroke = figures::Stroke::dashed, .colour = figures::kVermilion};
  for (const MapKey& one : dysfunctions) {
    rings.paths.push_back(one.outline);
    plot.places.push_back({.at = one.at, .text = one.name, .marker = figures::Marker::cross});
  }
  plot.shapes.push_back(std::move(rings));
}

figures::Figure mapFigure(const MapSkin& skin, const SkinMap& map) {
  figures::Plot plot;
  plot.title = map.title;
  plot.equal_aspect = true;
  plot.x.label = "x, to the patient's right";
  plot.y.label = "y, towards the head";
  plot.x.unit = plot.y.unit = "mm";
  plot.field = makeMapField(skin, map);
  if (map.shown.directions) plot.shapes.push_back(directionStrokes(*plot.field));
  figures::Shape outlines = keyPointOutlines(map.keys);
  if (!outlines.paths.empty()) plot.shapes.push_back(std::move(outlines));
  for (const MapKey& key : map.keys) plot.places.push_back({.at = key.at, .text = key.name});
  addDysfunctions(map.dysfunctions, plot);
  figures::Figure figure;
  figure.panels.emplace_back(std::move(plot));
  figure.panel_width_px = 560.0;
  figure.panel_height_px = 640.0;
  figure.note = map.note;
  return figure;
}

}  // namespace

const std::vector<double>& columnOf(const SkinMap& map, const std::string& name) {
  const auto named = [&](const MapColumn& column) { return column.name == name; };
  return std::find_if(map.vertices.begin(), map.vertices.end(), named)->values;
}

std::pair<double, double> shownRange(const SkinMap& map) {
  if (map.shown.range) return *map.shown.range;
  const std::vector<double>& values = columnOf(map, map.shown.column);
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  if (!map.shown.middle) return {*least, *most};
  // From 0 to twice the middle at most: lengths are never below 0.
  const double reach = std::min(*map.shown.middle, std::max(*most - *map.shown.middle, *map.shown.middle - *least));
  return {*map.shown.middle - reach, *map.shown.middle + reach};
}

void requireMapFile(const std::filesystem::path& file) {
  if (std::find(kExtensions.begin(), kExtensions.end(), file.extension().string()) != kExtensions.end()) return;
  throw Error::inFile(file.string(), fmt::format("a map's name must end in one of {}", fmt::join(kExtensions, ", ")));
}

void writeMap(const std::filesystem::path& file, const MapSkin& skin, const SkinMap& map, const MapOutput& output) {
  requireMapFile(file);
  const std::string extension = file.extension().string();
  if (extension == ".csv") {
    writeFile(file, output.grid_mm > 0.0 ? csvOfGrid(skin, map, output.grid_mm) : csvOfVertices(skin, map));
  } else if (extension == ".ply") {
    writePly(file, skin, map);
  } else if (extension == ".png") {
    figures::writePng(mapFigure(skin, map), file, output.png_scale);
  } else {
    figures::writeSvg(mapFigure(skin, map), file);
  }
}

}  // namespace palpate::app
