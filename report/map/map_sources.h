// From key points to the maps that `palpate body map` writes - ellipses, irregular contours, stiffness, depth of the
// bones: numbers for every vertex and every place, what is shown of them, and the key points they come from.
#pragma once

#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "palpate/base/colour_map.h"
#include "palpate/base/fidelity.h"
#include "palpate/maps/contour_map.h"
#include "palpate/maps/ellipse_map.h"
#include "palpate/maps/literal_ellipse_map.h"
#include "palpate/maps/measured_stiffness.h"
#include "report/map/map_skin.h"

namespace palpate::app {

/// What the subcommands of `map` were told about their source.
struct MapSource {
  std::string key_file;  ///< empty: the dissertation's key points
  maps::MeasuredDataChoice measured;
  maps::EllipseMapSettings ellipses;
  Fidelity fidelity;
  std::optional<maps::LiteralWeights> weights;         ///< nothing: as the fidelity says
  std::optional<maps::DirectionBlend> directions;      ///< nothing: as the fidelity says
  std::string quantity = "half-major";                 ///< of ellipses: half-major, aspect or direction
  std::size_t contour_radii = maps::kMaxContourRadii;  ///< of the contours made from ellipses
  maps::MeasuredStiffness stiffness;
  bool interpolate_depth = false;  ///< stiffness without key file: measure the torso at the seven places
};

struct MapColumn {
  std::string name;  ///< with its unit
  std::vector<double> values;
};

/// A key point as it is drawn: its outline in true size round its place; no outline without one.
struct MapKey {
  std::string name;
  Vec2 at = Vec2::Zero();
  std::vector<Vec2> outline;
};

/// The quantity that is coloured.
struct ShownQuantity {
  std::string column;
  std::string label;
  std::string unit;
  ColourMap colours = ColourMap::viridis;
  std::optional<double> middle = {};                    ///< of a diverging map: the value that is grey
  std::optional<std::pair<double, double>> range = {};  ///< where it is not that of the data
  bool directions = false;  ///< degrees of undirected axes: strokes instead of contour lines
};

/// A map over a skin, ready to be written (map_output.h).
struct SkinMap {
  std::string title;
  std::string note;                 ///< below a picture
  std::vector<MapColumn> vertices;  ///< a value a vertex each
  /// Columns of the map plane and their values at a place; without a function the shown vertex column is interpolated.
  std::vector<std::string> plane_columns;
  std::function<std::vector<double>(const Vec2&)> plane;
  ShownQuantity shown;
  std::vector<MapKey> keys;
  std::vector<MapKey> dysfunctions;  ///< outlined in true size
  nlohmann::ordered_json summary;    ///< settings and fit errors
};

/// The vertex column of this name.
const std::vector<double>& columnOf(const SkinMap& map, const std::string& name);

SkinMap ellipsesOver(const MapSkin& skin, const MapSource& source);
/// Of a map that is there already. `settings` is what it was made with.
SkinMap ellipsesOver(const MapSkin& skin, const maps::AnyEllipseMap& ellipses, const maps::EllipseMapSettings& settings,
                     const std::string& quantity);
SkinMap contoursOver(const MapSkin& skin, const MapSource& source);
/// From a key file with a stiffness, or from the depth of the bones of the torso. Throws Error where there is neither.
SkinMap stiffnessOver(const MapSkin& skin, const MapSource& source);
/// Of values that are there already, N/mm, a vertex each.
SkinMap stiffnessOver(const MapSkin& skin, std::vector<double> n_per_mm);
/// From the skin to the nearest bone. Throws Error for a skin without bones.
SkinMap depthOver(const MapSkin& skin);

/// Places with their ellipses as outlines.
std::vector<MapKey> drawnKeys(std::span<const maps::KeyPoint> keys);

}  // namespace palpate::app
