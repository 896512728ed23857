#include "report/map/map_sources.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/maps/stiffness_map.h"
#include "report/charts/plot.h"

namespace palpate::app {

namespace {

std::vector<maps::KeyPoint> loadKeyPoints(const MapSource& source) {
  if (!source.key_file.empty()) return maps::readKeyPoints(source.key_file);
  maps::MeasuredDataChoice measured = source.measured;
  if (source.fidelity.literal(Erratum::E30_key_averages)) measured.averaging = maps::Averaging::plain;
  return maps::dissertationKeyPoints(measured);
}

maps::LiteralForms formsOf(const MapSource& source) {
  maps::LiteralForms forms = maps::literalForms(source.fidelity);
  if (source.weights) forms.weights = source.weights;
  if (source.directions) forms.direction = *source.directions;
  return forms;
}

Json toJson(const maps::FitError& error) { return {{"rms", error.rms}, {"max", error.max}}; }

/// Root of the mean square and largest of differences.
maps::FitError computeFitError(const std::vector<double>& differences) {
  maps::FitError error;
  for (const double d : differences) {
    error.rms += d * d;
    error.max = std::max(error.max, std::abs(d));
  }
  if (!differences.empty()) error.rms = std::sqrt(error.rms / static_cast<double>(differences.size()));
  return error;
}

/// Between undirected axes, 0 to 90 degree.
double axesApartDeg(double a_rad, double b_rad) {
  return std::asin(std::min(1.0, std::abs(std::sin(a_rad - b_rad)))) / kRadPerDeg;
}

std::vector<double> numbersOf(const maps::Ellipse& e) {
  const bool is_empty = !(e.half_major_mm > 0.0);
  return {e.half_major_mm, e.aspect, is_empty ? 1.0 : 1.0 / e.aspect, e.direction_rad / kRadPerDeg};
}

/// Fills the vertex columns `first` and following from rows of numbers.
void appendRow(std::vector<MapColumn>& columns, std::size_t first, const std::vector<double>& row) {
  for (std::size_t c = 0; c < row.size(); ++c) columns[first + c].values.push_back(row[c]);
}

ShownQuantity shownOfEllipses(const std::string& quantity, double basic_radius_mm) {
  if (quantity == "aspect") {
    return {.column = "aspect", .label = "aspect, minor / major axis", .unit = "", .colours = ColourMap::cividis};
  }
  if (quantity == "direction") {
    return {.column = "direction_deg",
            .label = "direction of the major axis",
            .unit = "degree",
            .colours = ColourMap::cyclic,
            .range = std::pair{0.0, 180.0},
            .directions = true};
  }
  return {.column = "half_major_mm",
          .label = "half-major axis",
          .unit = "mm",
          .colours = ColourMap::cool_warm,
          .middle = basic_radius_mm};
}

Json errorsAtKeys(const maps::AnyEllipseMap& map) {
  std::vector<double> half_major;
  std::vector<double> aspect;
  std::vector<double> direction;
  for (const maps::KeyPoint& key : map.keys()) {
    const maps::Ellipse e = map.at(key.position_mm.x(), key.position_mm.y());
    half_major.push_back(e.half_major_mm - key.ellipse.half_major_mm);
    aspect.push_back(e.aspect - key.ellipse.aspect);
    direction.push_back(axesApartDeg(e.direction_rad, key.ellipse.direction_rad));
  }
  return {{"half_major_mm", toJson(computeFitError(half_major))},
          {"aspect", toJson(computeFitError(aspect))},
          {"direction_deg", toJson(computeFitError(direction))}};
}

Json toJson(std::span<const maps::KeyPoint> keys) {
  Json list = Json::array();
  for (const maps::KeyPoint& key : keys) {
    Json one{{"name", key.name}, {"x_mm", key.position_mm.x()}, {"y_mm", key.position_mm.y()}};
    if (key.ellipse.half_major_mm > 0.0) {
      one["half_major_mm"] = key.ellipse.half_major_mm;
      one["major_over_minor"] = 1.0 / key.ellipse.aspect;
      one["direction_deg"] = key.ellipse.direction_rad / kRadPerDeg;
    }
    if (key.stiffness_n_per_mm) one["stiffness_n_per_mm"] = *key.stiffness_n_per_mm;
    list.push_back(std::move(one));
  }
  return list;
}

// ---- contours

std::vector<maps::ContourPoint> contourPointsOf(const MapSource& source) {
  if (!source.key_file.empty()) return maps::readContourPoints(source.key_file);
  return maps::contourPointsOf(loadKeyPoints(source), source.contour_radii);
}

/// The geometric mean of the radii, then the radii.
std::vector<double> numbersOf(const maps::PolarContour& contour) {
  std::vector<double> row{0.0};
  double sum = 0.0;
  for (std::size_t i = 0; i < contour.count; ++i) {
    sum += contour.log_radii[i];
    row.push_back(std::exp(contour.log_radii[i]));
  }
  row[0] = std::exp(sum / static_cast<double>(contour.count));
  return row;
}

MapKey drawnKey(const maps::ContourPoint& point) {
  MapKey key{point.name, point.position_mm, {}};
  for (int degree = 0; degree < 360; degree += 3) {
    const Vec2 direction(std::cos(degree * kRadPerDeg), std::sin(degree * kRadPerDeg));
    key.outline.emplace_back(point.position_mm + maps::radiusAt(point.contour, degree * kRadPerDeg) * direction);
  }
  return key;
}

maps::FitError radiusErrorAtKeys(const std::vector<maps::ContourPoint>& points, const maps::PolarContourMap& map) {
  std::vector<double> differences;
  for (const maps::ContourPoint& point : points) {
    const maps::PolarContour here = map.at(point.position_mm.x(), point.position_mm.y());
    for (std::size_t i = 0; i < here.count; ++i) {
      differences.push_back(std::exp(here.log_radii[i]) - std::exp(point.contour.log_radii[i]));
    }
  }
  return computeFitError(differences);
}

// ---- stiffness

void requireStiffness(const std::vector<maps::KeyPoint>& keys, const std::string& file) {
  const auto has = [](const maps::KeyPoint& key) { return key.stiffness_n_per_mm.has_value(); };
  if (!std::any_of(keys.begin(), keys.end(), has))
    throw Error::inFile(file, "no key point has a stiffness_n_per_mm; at least one is needed");
}

/// The seven places of the dissertation, each with the stiffness that the skin nearest to it (seen along z) has.
std::vector<maps::KeyPoint> measuredOn(const MapSkin& skin, const std::vector<double>& stiffness) {
  std::vector<maps::KeyPoint> keys = maps::dissertationKeyPoints();
  for (maps::KeyPoint& key : keys) {
    const auto distance = [&](const Vec3& p) { return (p.head<2>() - key.position_mm).squaredNorm(); };
    const auto nearest = std::min_element(skin.mesh.positions.begin(), skin.mesh.positions.end(),
                                          [&](const Vec3& a, const Vec3& b) { return distance(a) < distance(b); });
    key.stiffness_n_per_mm = stiffness[static_cast<std::size_t>(nearest - skin.mesh.positions.begin())];
    key.ellipse = {};
  }
  return keys;
}

SkinMap emptyStiffnessMap() {
  SkinMap map;
  map.title = "Stiffness of the body";
  map.shown = {.column = "stiffness_n_per_mm", .label = "stiffness", .unit = "N/mm", .colours = ColourMap::viridis};
  map.summary = {{"map", "stiffness"}};
  return map;
}

SkinMap stiffnessFromKeys(const MapSkin& skin, const std::vector<maps::KeyPoint>& keys, const MapSource& source) {
  SkinMap map = emptyStiffnessMap();
  maps::StiffnessOfPositions stiffness = maps::measuredStiffness(skin.mesh.positions, keys, source.stiffness);
  map.summary["keys"] = toJson(keys);
  map.summary["fit_error_n_per_mm"] = toJson(stiffness.error);
  map.summary["limited_vertices"] = stiffness.limited;
  map.vertices = {{"stiffness_n_per_mm", std::move(stiffness.n_per_mm)}};
  map.plane_columns = {"stiffness_n_per_mm"};
  const auto field = std::make_shared<const maps::MeasuredStiffnessField>(keys, source.stiffness);
  map.plane = [field](const Vec2& place) { return std::vector<double>{field->at(place)}; };
  map.keys = drawnKeys(keys);
  return map;
}

}  // namespace

std::vector<MapKey> drawnKeys(std::span<const maps::KeyPoint> keys) {
  std::vector<MapKey> drawn;
  for (const maps::KeyPoint& key : keys) {
    const maps::Ellipse& e = key.ellipse;
    MapKey one{key.name, key.position_mm, {}};
    if (e.half_major_mm > 0.0) {
      one.outline =
          figures::ellipseOutline(key.position_mm, e.half_major_mm, e.half_major_mm * e.aspect, e.direction_rad);
    }
    drawn.push_back(std::move(one));
  }
  return drawn;
}

SkinMap ellipsesOver(const MapSkin& skin, const MapSource& source) {
  const maps::AnyEllipseMap ellipses(loadKeyPoints(source), source.ellipses, formsOf(source));
  return ellipsesOver(skin, ellipses, source.ellipses, source.quantity);
}

SkinMap ellipsesOver(const MapSkin& skin, const maps::AnyEllipseMap& of_keys, const maps::EllipseMapSettings& settings,
                     const std::string& quantity) {
  const auto ellipses = std::make_shared<const maps::AnyEllipseMap>(of_keys);
  SkinMap map;
  map.shown = shownOfEllipses(quantity, settings.basic_radius_mm);
  map.title = "Deformation ellipses: " + map.shown.label;
  map.plane_columns = {"half_major_mm", "aspect", "major_over_minor", "direction_deg"};
  map.plane = [ellipses](const Vec2& place) { return numbersOf(ellipses->at(place.x(), place.y())); };
  map.keys = drawnKeys(ellipses->keys());
  map.summary = {{"map", "ellipses"},
                 {"effect_radius_mm", settings.effect_radius_mm},
                 {"basic_radius_mm", settings.basic_radius_mm},
                 {"keys", toJson(ellipses->keys())},
                 {"fit_error", errorsAtKeys(*ellipses)}};

  for (const std::string& name : map.plane_columns) map.vertices.push_back({name, {}});
  for (const char* name : {"axis_x_mm", "axis_y_mm", "axis_z_mm"}) map.vertices.push_back({name, {}});
  for (std::size_t v = 0; v < skin.mesh.positions.size(); ++v) {
    const Vec3& p = skin.mesh.positions[v];
    const Vec3 axis = ellipses->on(p, skin.normals[v]).half_major;
    appendRow(map.vertices, 0, map.plane(p.head<2>()));
    appendRow(map.vertices, map.plane_columns.size(), {axis.x(), axis.y(), axis.z()});
  }
  return map;
}

SkinMap makeContourMap(const MapSkin& skin, const MapSource& source) {
  const std::vector<maps::ContourPoint> points = contourPointsOf(source);
  const auto contours = std::make_shared<const maps::PolarContourMap>(points, source.ellipses);
  SkinMap map;
  map.title = "Deformation contours: mean radius";
  map.shown = {.column = "mean_radius_mm",
               .label = "mean radius of the contour",
               .unit = "mm",
               .colours = ColourMap::cool_warm,
               .middle = source.ellipses.basic_radius_mm};
  map.plane_columns = {"mean_radius_mm"};
  for (std::size_t i = 0; i < contours->radii(); ++i) map.plane_columns.push_back(fmt::format("r{}_mm", i));
  map.plane = [contours](const Vec2& place) { return numbersOf(contours->at(place.x(), place.y())); };
  for (const std::string& name : map.plane_columns) map.vertices.push_back({name, {}});
  for (const Vec3& p : skin.mesh.positions) appendRow(map.vertices, 0, map.plane(p.head<2>()));
  for (const maps::ContourPoint& point : points) map.keys.push_back(drawnKey(point));
  map.summary = {{"map", "contours"},
                 {"radii", contours->radii()},
                 {"effect_radius_mm", source.ellipses.effect_radius_mm},
                 {"basic_radius_mm", source.ellipses.basic_radius_mm},
                 {"key_points", points.size()},
                 {"fit_error", {{"radius_mm", toJson(radiusErrorAtKeys(points, *contours))}}}};
  return map;
}

SkinMap makeStiffnessMap(const MapSkin& skin, const MapSource& source) {
  if (!source.key_file.empty()) {
    const std::vector<maps::KeyPoint> keys = maps::readKeyPoints(source.key_file);
    requireStiffness(keys, source.key_file);
    return stiffnessFromKeys(skin, keys, source);
  }
  if (skin.bone_depth_mm.empty()) throw Error("map stiffness: needs --keys with a stiffness, or the torso's bones");
  std::vector<double> stiffness = maps::stiffnessFromDepth(skin.bone_depth_mm);
  if (source.interpolate_depth) return stiffnessFromKeys(skin, measuredOn(skin, stiffness), source);
  SkinMap map = makeStiffnessMap(skin, std::move(stiffness));
  map.summary["source"] = "depth of the bones";
  return map;
}

SkinMap makeStiffnessMap(const MapSkin& skin, std::vector<double> n_per_mm) {
  SkinMap map = emptyStiffnessMap();
  if (n_per_mm.size() != skin.mesh.positions.size()) throw Error("map stiffness: needs a value for every vertex");
  map.vertices = {{"stiffness_n_per_mm", std::move(n_per_mm)}};
  map.plane_columns = {"stiffness_n_per_mm"};
  return map;
}

SkinMap depthOver(const MapSkin& skin) {
  if (skin.bone_depth_mm.empty()) throw Error("map depth: needs bones, which only the built-in torso has");
  SkinMap map;
  map.title = "Depth of the bones under the skin";
  map.shown = {.column = "bone_depth_mm", .label = "from skin to bone", .unit = "mm", .colours = ColourMap::cividis};
  map.vertices = {{"bone_depth_mm", skin.bone_depth_mm}};
  map.plane_columns = {"bone_depth_mm"};
  map.summary = {{"map", "depth"}};
  return map;
}

}  // namespace palpate::app
