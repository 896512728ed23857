// What a map is drawn over: the built-in torso or back, or a mesh file; and how it looks from behind, on a grid.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "cli/kit/mesh_arguments.h"
#include "palpate/base/vec.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::app {

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
struct GridSpot {
  Index triangle = kNoIndex;        ///< kNoIndex beside the skin
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

/// A value a vertex, interpolated at a place on the skin; NaN beside it.
double valueAt(const mesh::TriangleMesh& mesh, const GridSpot& spot, const std::vector<double>& of_vertices);

}  // namespace palpate::app
