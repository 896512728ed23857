// Rays from some vertices of each cell of a grid, then for each vertex the mean of the cells around it; of logarithms,
// as thicknesses are blended everywhere.
#include "palpate/scene/beneath/tissue_beneath.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "palpate/base/elementary.h"
#include "palpate/tree/triangle_tree.h"

namespace palpate::scene {

namespace {

constexpr double kCellMm = 6.0;
/// A vertex is told by what lies within this distance, hence in the 27 cells around it.
constexpr double kEvenedOverMm = 9.0;
/// Rays a cell: on a dense mesh not every vertex asks.
constexpr int kRays = 4;
constexpr double kMaxOverNearest = 1.5;

struct Cell {
  Vec3 sum = Vec3::Zero();  ///< of the places that asked
  double log_sum = 0.0;
  int rays = 0;
};

using Place = std::array<std::int32_t, 3>;

struct PlaceHash {
  std::size_t operator()(const Place& place) const noexcept {
    std::uint64_t hash = 0;
    for (const std::int32_t i : place) hash = (hash ^ static_cast<std::uint32_t>(i)) * 0x9e3779b97f4a7c15u;
    return static_cast<std::size_t>(hash ^ (hash >> 29));
  }
};

using Cells = std::unordered_map<Place, Cell, PlaceHash>;

Place placeOf(const Vec3& point) {
  Place place{};
  for (int axis = 0; axis < 3; ++axis) {
    place[static_cast<std::size_t>(axis)] = static_cast<std::int32_t>(std::floor(point[axis] / kCellMm));
  }
  return place;
}

double alongRay(const tree::TriangleTree& bones, const Vec3& point, const Vec3& normal, double nearest_mm) {
  const double most = kMaxOverNearest * nearest_mm;
  const tree::Crossing hit = tree::firstFrontCrossing(bones, point, point - most * normal);
  return hit.triangle == kNoIndex ? most : std::max(nearest_mm, hit.fraction * most);
}

Cells probeCells(const mesh::TriangleMesh& skin, std::span<const double> nearest_mm, const tree::TriangleTree& bones) {
  const std::vector<Vec3> normals = mesh::vertexNormals(skin);
  Cells cells;
  for (std::size_t v = 0; v < skin.positions.size(); ++v) {
    Cell& cell = cells[placeOf(skin.positions[v])];
    if (cell.rays >= kRays || !(nearest_mm[v] > 0.0) || !std::isfinite(nearest_mm[v])) continue;
    ++cell.rays;
    cell.sum += skin.positions[v];
    cell.log_sum += elementary::log(alongRay(bones, skin.positions[v], normals[v], nearest_mm[v]));
  }
  return cells;
}

/// Falls from 1 to 0 at kEvenedOverMm.
double weightAt(double squared_mm) {
  const double within = 1.0 - squared_mm / (kEvenedOverMm * kEvenedOverMm);
  return within > 0.0 ? within * within : 0.0;
}

/// Weighted mean of the cells around; NaN if none of them has a ray.
double evenedLog(const Cells& cells, const Vec3& point) {
  const Place middle = placeOf(point);
  double sum = 0.0;
  double weights = 0.0;
  for (std::int32_t i = 0; i < 27; ++i) {
    const auto found = cells.find({middle[0] + i % 3 - 1, middle[1] + i / 3 % 3 - 1, middle[2] + i / 9 - 1});
    if (found == cells.end() || found->second.rays == 0) continue;
    const Cell& cell = found->second;
    const double weight = weightAt((cell.sum / cell.rays - point).squaredNorm()) * cell.rays;
    sum += weight * cell.log_sum / cell.rays;
    weights += weight;
  }
  return weights > 0.0 ? sum / weights : std::nan("");
}

mesh::TriangleMesh joined(std::span<const body::Bone> bones) {
  mesh::TriangleMesh all;
  for (const body::Bone& bone : bones) mesh::append(bone.mesh, all);
  return all;
}

}  // namespace

std::vector<float> tissueBeneath(const mesh::TriangleMesh& skin, std::span<const double> nearest_mm,
                                 std::span<const body::Bone> bones) {
  const tree::TriangleTree tree = tree::buildTriangleTree(joined(bones));
  const Cells cells = probeCells(skin, nearest_mm, tree);
  std::vector<float> thickness;
  thickness.reserve(skin.positions.size());
  for (std::size_t v = 0; v < skin.positions.size(); ++v) {
    const double log_mm = evenedLog(cells, skin.positions[v]);
    thickness.push_back(static_cast<float>(std::isfinite(log_mm) ? elementary::exp(log_mm) : nearest_mm[v]));
  }
  return thickness;
}

}  // namespace palpate::scene
