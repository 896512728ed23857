// Skins to draw a map over, and the skin as it looks from behind: its triangles rasterised into a grid, the uppermost
// kept at every node (a depth buffer).
#include "report/map/map_sources.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "palpate/base/error.h"
#include "palpate/body/torso.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::app {

namespace {

/// 16 million nodes: a quarter of a gigabyte, and finer than any picture.
constexpr double kMaxNodes = 16e6;

/// Twice the signed area of a triangle of the map plane.
double doubleArea(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

/// Nodes from `low` to `high` along one axis, cut to the grid.
std::pair<int, int> nodesBetween(double low, double high, double origin, double step, int nodes) {
  return {std::max(0, static_cast<int>(std::ceil((low - origin) / step))),
          std::min(nodes - 1, static_cast<int>(std::floor((high - origin) / step)))};
}

/// Enters one triangle wherever it is the uppermost so far.
void enter(const mesh::TriangleMesh& mesh, Index triangle, SkinGrid& grid, std::vector<double>& height) {
  const Triangle& t = mesh.triangles[triangle];
  const Vec3& a = mesh.positions[t[0]];
  const Vec3& b = mesh.positions[t[1]];
  const Vec3& c = mesh.positions[t[2]];
  const double area = doubleArea(a.head<2>(), b.head<2>(), c.head<2>());
  if (!(std::abs(area) > 0.0)) return;  // seen edge on
  const auto [x0, x1] = nodesBetween(std::min({a.x(), b.x(), c.x()}), std::max({a.x(), b.x(), c.x()}), grid.origin.x(),
                                     grid.step_mm, grid.columns);
  const auto [y0, y1] = nodesBetween(std::min({a.y(), b.y(), c.y()}), std::max({a.y(), b.y(), c.y()}), grid.origin.y(),
                                     grid.step_mm, grid.rows);
  for (int row = y0; row <= y1; ++row) {
    for (int column = x0; column <= x1; ++column) {
      const std::size_t i = static_cast<std::size_t>(row) * grid.columns + column;
      const Vec2 p = grid.node(i);
      const double u = doubleArea(p, b.head<2>(), c.head<2>()) / area;
      const double v = doubleArea(a.head<2>(), p, c.head<2>()) / area;
      const double w = 1.0 - u - v;
      constexpr double kEdge = -1e-9;  // nodes on an edge belong to both sides
      const double z = u * a.z() + v * b.z() + w * c.z();
      if (std::min({u, v, w}) < kEdge || z <= height[i]) continue;
      height[i] = z;
      grid.spots[i] = {triangle, {u, v, w}};
    }
  }
}

}  // namespace

MapSkin builtInTorso(std::size_t triangles) {
  body::TorsoSettings settings;
  settings.triangles = triangles;
  body::Torso torso = body::makeTorso(settings);
  return {"torso", std::move(torso.skin.mesh), std::move(torso.skin.normals), std::move(torso.depth_mm)};
}

MapSkin builtInBack(std::size_t triangles) {
  body::BackSettings settings;
  settings.triangles = triangles;
  body::Skin skin = body::makeBackSkin(settings);
  return {"back", std::move(skin.mesh), std::move(skin.normals), {}};
}

MapSkin skinOfFile(const MeshArguments& arguments) {
  MapSkin skin;
  skin.name = arguments.file;
  mesh::MeshWithChannels loaded = mesh::loadWithChannels(arguments.file, arguments.options);
  skin.mesh = std::move(loaded.mesh);
  skin.notes = std::move(loaded.notes);
  if (skin.mesh.triangles.empty()) throw Error::inFile(arguments.file, "has no triangles to draw a map over");
  skin.normals = mesh::vertexNormals(skin.mesh);
  return skin;
}

SkinGrid gridOver(const mesh::TriangleMesh& mesh, double step_mm) {
  const Eigen::AlignedBox3d box = mesh::boundingBox(mesh);
  const Vec2 nodes = box.sizes().head<2>() / step_mm + Vec2::Ones();
  if (!(step_mm > 0.0) || !(nodes.prod() <= kMaxNodes))
    throw Error("map: the grid's step is too small; choose a larger --grid-mm");
  SkinGrid grid{box.min().head<2>(), step_mm, static_cast<int>(nodes.x()), static_cast<int>(nodes.y()), {}};
  grid.spots.resize(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows));
  std::vector<double> height(grid.spots.size(), -std::numeric_limits<double>::infinity());
  for (Index t = 0; t < mesh.triangles.size(); ++t) enter(mesh, t, grid, height);
  return grid;
}

double valueAt(const mesh::TriangleMesh& mesh, const GridSpot& spot, const std::vector<double>& of_vertices) {
  if (spot.triangle == kNoIndex) return std::numeric_limits<double>::quiet_NaN();
  const Triangle& t = mesh.triangles[spot.triangle];
  double value = 0.0;
  for (std::size_t corner = 0; corner < 3; ++corner) value += spot.weights[corner] * of_vertices[t[corner]];
  return value;
}

}  // namespace palpate::app
