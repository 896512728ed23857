// A map over a skin, ready to be written: numbers for every vertex and every place, what is shown of them, and the key
// points they come from.
//
// Made by map_sources.h, written by map_output.h.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "palpate/base/colour_map.h"
#include "palpate/base/vec.h"

namespace palpate::app {

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
  std::optional<double> middle;                    ///< of a diverging map: the value that is grey
  std::optional<std::pair<double, double>> range;  ///< where it is not that of the data
  bool directions = false;                         ///< degrees of undirected axes: strokes instead of contour lines
};

struct SkinMap {
  std::string title;
  std::vector<MapColumn> vertices;  ///< a value a vertex each
  /// Columns of the map plane and their values at a place; without a function the shown vertex column is interpolated.
  std::vector<std::string> plane_columns;
  std::function<std::vector<double>(const Vec2&)> plane;
  ShownQuantity shown;
  std::vector<MapKey> keys;
  nlohmann::ordered_json summary;  ///< settings and fit errors
};

/// The vertex column of this name.
const std::vector<double>& columnOf(const SkinMap& map, const std::string& name);

}  // namespace palpate::app
