// From key points to the maps that `palpate body map` writes - ellipses, irregular contours, stiffness, depth of the
// bones: numbers for every vertex and every place, what is shown of them, and the key points they come from.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "cli/kit/mesh_arguments.h"
#include "palpate/base/colour_map.h"
#include "palpate/base/fidelity.h"
#include "palpate/base/json.h"
#include "palpate/base/vec.h"
#include "palpate/maps/contour_map.h"
#include "palpate/maps/ellipse_map.h"
#include "palpate/maps/literal_ellipse_map.h"
#include "palpate/maps/measured_stiffness.h"
#include "palpate/mesh/triangle_mesh.h"
#include "palpate/scene/world.h"

namespace palpate::app {

// The surface under a map: the built-in torso or back, or a mesh file; and how it looks from behind, on a grid.

struct MapSkin {
  std::string name;  ///< "torso", "back" or the file
  mesh::TriangleMesh mesh;
  std::vector<Vec3> normals;            ///< unit, one per vertex
  std::vector<double> bone_depth_mm;    ///< one per vertex; empty without known bones
  std::vector<std::string> notes = {};  ///< for a file: passed over or guessed while it was read
};

MapSkin builtInTorso(std::size_t triangles);
MapSkin builtInBack(std::size_t triangles);
/// Without repair. Throws Error for a mesh without a triangle.
MapSkin skinOfFile(const MeshArguments& arguments);

/// The skin below one node of the grid, seen along -z.
struct GridSpot {
  Index triangle = kNoIndex;        ///< kNoIndex outside the skin
  std::array<double, 3> weights{};  ///< barycentric
};

/// The map plane over the skin's bounding box. Nodes row by row from the lowest corner, x first.
struct SkinGrid {
  Vec2 origin = Vec2::Zero();
  double step_mm = 1.0;
  int columns = 0;
  int rows = 0;
  std::vector<GridSpot> spots;  ///< columns x rows

  Vec2 node(std::size_t i) const {
    const auto width = static_cast<std::size_t>(columns);
    const std::size_t row = i / width;
    return origin + step_mm * Vec2(static_cast<double>(i % width), static_cast<double>(row));
  }
};

/// The uppermost triangle at every node. Throws Error for a step that is not above 0 or makes more than 16 million
/// nodes.
SkinGrid gridOver(const mesh::TriangleMesh& mesh, double step_mm);

/// A value per vertex, interpolated at a place on the skin; NaN outside it.
double valueAt(const mesh::TriangleMesh& mesh, const GridSpot& spot, const std::vector<double>& of_vertices);

/// Options of the subcommands of `map` about their source.
struct MapSource {
  std::string key_file;  ///< empty: the dissertation's key points
  maps::MeasuredDataChoice measured;
  maps::EllipseMapSettings ellipses;
  Fidelity fidelity;
  std::optional<maps::LiteralWeights> weights;         ///< empty: the fidelity's
  std::optional<maps::DirectionBlend> directions;      ///< empty: the fidelity's
  std::string quantity = "half-major";                 ///< for ellipses: half-major, aspect or direction
  std::size_t contour_radii = maps::kMaxContourRadii;  ///< for contours made from ellipses
  maps::MeasuredStiffness stiffness;
  bool interpolate_depth = false;  ///< stiffness without key file: measure the torso at the seven places
};

struct MapColumn {
  std::string name;  ///< with its unit
  std::vector<double> values;
};

/// A key point as drawn: its outline in true size round its place; empty without one.
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
  std::optional<double> middle = {};                    ///< for a diverging map: the value that is grey
  std::optional<std::pair<double, double>> range = {};  ///< where it is not that of the data
  bool directions = false;  ///< degrees of undirected axes: strokes instead of contour lines
};

/// A map over a skin, ready to be written (map_output.h).
struct SkinMap {
  std::string title;
  std::string note;                 ///< below a picture
  std::vector<MapColumn> vertices;  ///< one value per vertex
  /// Columns of the map plane and their values at a place; without a function the shown vertex column is interpolated.
  std::vector<std::string> plane_columns;
  std::function<std::vector<double>(const Vec2&)> plane;
  ShownQuantity shown;
  std::vector<MapKey> keys;
  std::vector<MapKey> dysfunctions;  ///< outlined in true size
  Json summary;                      ///< settings and fit errors
};

/// The vertex column of this name.
const std::vector<double>& columnOf(const SkinMap& map, const std::string& name);

SkinMap ellipsesOver(const MapSkin& skin, const MapSource& source);
/// For a map that exists already, made with `settings`.
SkinMap ellipsesOver(const MapSkin& skin, const maps::AnyEllipseMap& ellipses, const maps::EllipseMapSettings& settings,
                     const std::string& quantity);
SkinMap makeContourMap(const MapSkin& skin, const MapSource& source);
/// From a key file with a stiffness, or from the depth of the bones of the torso. Throws Error where there is neither.
SkinMap makeStiffnessMap(const MapSkin& skin, const MapSource& source);
/// For values that exist already, N/mm, one per vertex.
SkinMap makeStiffnessMap(const MapSkin& skin, std::vector<double> n_per_mm);
/// From the skin to the nearest bone. Throws Error for a skin without bones.
SkinMap depthOver(const MapSkin& skin);

/// Places with their ellipses as outlines.
std::vector<MapKey> drawnKeys(std::span<const maps::KeyPoint> keys);

// The maps of a scene: of its body as felt, with its dysfunctions, instead of a bare skin.

/// The scene's body as built: mended and ordered, so its vertices are those of forces.csv's triangles.
MapSkin skinOfScene(const scene::World& world);

/// The stiffness that a finger meets: the healthy body, then its dysfunctions.
SkinMap stiffnessOfScene(const MapSkin& skin, const scene::World& world);
/// Throws Error for a body without bones.
SkinMap depthOfScene(const MapSkin& skin, const scene::World& world);
/// `quantity` is half-major, aspect or direction.
SkinMap ellipsesOfScene(const MapSkin& skin, const scene::World& world, const std::string& quantity);
/// The boundaries of drags as the deformation has them. Throws Error for a scene whose drags have no contours.
SkinMap contoursOfScene(const MapSkin& skin, const scene::World& world);

}  // namespace palpate::app
