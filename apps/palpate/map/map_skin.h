// What a map is drawn over: the built-in torso or back, or a mesh file; and how it looks from behind, on a grid.
#pragma once

#include <array>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/palpate/common/mesh_arguments.h"
#include "palpate/base/colour_map.h"
#include "palpate/base/vec.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::app {

// A map over a skin, ready to be written: numbers for every vertex and every place, what is shown of them, and the key
// points they come from.
//
// Made by map_sources.h, written by map_output.h.

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

struct MapSkin {
  std::string name;  ///< "torso", "back" or the file
  mesh::TriangleMesh mesh;
  std::vector<Vec3> normals;          ///< unit, a vertex each
  std::vector<double> bone_depth_mm;  ///< a vertex each; empty where no bones are known
};

MapSkin builtInTorso(std::size_t triangles);
MapSkin builtInBack(std::size_t triangles);
/// As it is, without repair. Throws Error for a mesh without a triangle.
MapSkin skinOfFile(const MeshArguments& arguments);

/// Where the skin is met when looking along -z at one node of the grid.
struct SkinPlace {
  Index triangle = kNoIndex;        ///< kNoIndex beside the skin
  std::array<double, 3> weights{};  ///< barycentric
};

/// The map plane over the skin's bounding box. Nodes row by row from the lowest corner, x first.
struct SkinGrid {
  Vec2 origin = Vec2::Zero();
  double step_mm = 1.0;
  int columns = 0;
  int rows = 0;
  std::vector<SkinPlace> places;  ///< columns x rows

  Vec2 node(std::size_t i) const {
    const auto width = static_cast<std::size_t>(columns);
    const std::size_t row = i / width;
    return origin + step_mm * Vec2(static_cast<double>(i % width), static_cast<double>(row));
  }
};

/// The uppermost triangle at every node. Throws Error for a step that is not above 0 or makes more than 16 million
/// nodes.
SkinGrid gridOver(const mesh::TriangleMesh& mesh, double step_mm);

/// A value a vertex, interpolated at a place on the skin; NaN beside it.
double valueAt(const mesh::TriangleMesh& mesh, const SkinPlace& place, const std::vector<double>& of_vertices);

}  // namespace palpate::app
