// Selects the triangles that a picture needs. Chunks of 64 triangles in spatial order have a sphere each, and so have
// cells of 8, 64, ... of them: outside a plane of the frustum they are left out, near an influence they count as
// touched. The coarser set is vertex clustering: each cube keeps one vertex per facing, and triangles that fold over
// go.
//
// Based on: Rossignac and Borrel, "Multi-resolution 3D approximations for rendering complex scenes", 1993 (clustering).
#include "palpate/view/layers/skin_chunks.h"

#include <algorithm>
#include <array>
#include <limits>
#include <tuple>
#include <utility>

namespace palpate::view {

namespace {

/// About a fingertip across on a back of 40,000 triangles.
constexpr Index kChunkTriangles = 64;
constexpr Index kChunkIndices = 3 * kChunkTriangles;
/// Skin moves no farther (the default caps of 10 and 20 mm together).
constexpr float kMaxDisplacementMm = 25.0f;
/// Skin that moves farther than this is so near the finger that it counts as touched where it was.
constexpr float kTouchedDisplacementMm = 12.0f;

using Planes = std::array<Eigen::Vector4f, 6>;

/// Inside is positive; lengths in mm.
Planes planesOf(const Mat4f& clip) {
  Planes planes;
  for (int axis = 0; axis < 3; ++axis) {
    planes[2 * axis] = clip.row(3) + clip.row(axis);
    planes[2 * axis + 1] = clip.row(3) - clip.row(axis);
  }
  for (Eigen::Vector4f& plane : planes) plane /= plane.head<3>().norm();
  return planes;
}

/// Chunks in a cell of the tree, and cells in the next larger one.
constexpr std::size_t kCellParts = 8;
/// The sphere of a cell is this much too large, so that rounding never decides against a chunk in it.
constexpr float kRoundingMm = 0.01f;

/// Depth of a point inside the frustum: its distance from the nearest plane.
float insideBy(const Planes& planes, const Vec3f& point) {
  float least = std::numeric_limits<float>::infinity();
  for (const Eigen::Vector4f& plane : planes) least = std::min(least, plane.dot(point.homogeneous()));
  return least;
}

bool isNear(const Influence& influence, const Vec3f& centre, float radius) {
  const Vec3f along = influence.to - influence.from;
  const float squared = along.squaredNorm();
  const float t = squared > 0.0f ? std::clamp((centre - influence.from).dot(along) / squared, 0.0f, 1.0f) : 0.0f;
  return (influence.from + t * along - centre).norm() < radius + influence.radius_mm;
}

void append(std::vector<IndexRun>& runs, Index first, Index count) {
  if (!runs.empty() && runs.back().first + runs.back().count == first) {
    runs.back().count += count;
  } else {
    runs.push_back({first, count});
  }
}

/// A cube, and which way the skin faces in it, so that the two sides of a thin part stay apart.
using Cell = std::array<int, 4>;

Cell vertexCell(const DrawnShape& shape, Index v, float cell_mm) {
  const Vec3f cell = (shape.places[v] / cell_mm).array().floor();
  const Vec3f normal = shape.normals[v];
  const int octant = (normal.x() > 0.0f ? 1 : 0) + (normal.y() > 0.0f ? 2 : 0) + (normal.z() > 0.0f ? 4 : 0);
  return {static_cast<int>(cell.x()), static_cast<int>(cell.y()), static_cast<int>(cell.z()), octant};
}

struct CellMember {
  Cell cell;
  float from_middle;
  Index vertex;
  friend bool operator<(const CellMember& a, const CellMember& b) {
    return std::tie(a.cell, a.from_middle, a.vertex) < std::tie(b.cell, b.from_middle, b.vertex);
  }
};

/// All vertices by their cells, in each the nearest to its middle first.
std::vector<CellMember> groupByCell(const DrawnShape& shape, float cell_mm) {
  std::vector<CellMember> members;
  members.reserve(shape.places.size());
  for (Index v = 0; v < shape.places.size(); ++v) {
    const Vec3f place = shape.places[v] / cell_mm;
    const Vec3f middle = place.array().floor() + 0.5f;
    members.push_back({vertexCell(shape, v, cell_mm), (place - middle).squaredNorm(), v});
  }
  std::sort(members.begin(), members.end());
  return members;
}

/// The representative of each vertex: the nearest to the middle of its cell, or itself when it stays.
std::vector<Index> keptVertices(const DrawnShape& shape, std::span<const Required> stays, float cell_mm) {
  const std::vector<CellMember> members = groupByCell(shape, cell_mm);
  std::vector<Index> kept(shape.places.size());
  for (auto first = members.begin(); first != members.end();) {
    const auto end = std::find_if(first, members.end(), [&](const CellMember& m) { return m.cell != first->cell; });
    const bool all = std::any_of(first, end, [&](const CellMember& m) { return stays[m.vertex] == Required::cell; });
    const Index keeper = first->vertex;
    for (; first != end; ++first) {
      kept[first->vertex] = all || stays[first->vertex] == Required::vertex ? first->vertex : keeper;
    }
  }
  return kept;
}

/// Still visible from the side that its corners face; folds are not, and their neighbours cover their place.
bool facesOut(const DrawnShape& shape, const Triangle& t) {
  const Vec3f a = shape.places[t[0]];
  const Vec3f area = (shape.places[t[1]] - a).cross(shape.places[t[2]] - a);
  const Vec3f normals = shape.normals[t[0]] + shape.normals[t[1]] + shape.normals[t[2]];
  constexpr float kMinCosine = 0.3f;  // steeper against its corners it is a fold too
  return area.dot(normals) > kMinCosine * area.norm() * normals.norm();
}

}  // namespace

std::vector<Triangle> coarserTriangles(const DrawnShape& shape, std::span<const Required> stays, float cell_mm) {
  const std::vector<Index> kept = keptVertices(shape, stays, cell_mm);
  std::vector<Triangle> triangles;
  for (const Triangle& t : shape.triangles) {
    const Triangle coarse = {kept[t[0]], kept[t[1]], kept[t[2]]};
    if (facesOut(shape, coarse)) triangles.push_back(coarse);
  }
  return triangles;
}

SkinChunks::SkinChunks(std::span<const Vec3f> places, std::span<const Triangle> triangles)
    : indices_(static_cast<Index>(3 * triangles.size())) {
  std::vector<Sphere>& chunks = levels_.emplace_back();
  for (std::size_t first = 0; first < triangles.size(); first += kChunkTriangles) {
    const std::size_t end = std::min(first + kChunkTriangles, triangles.size());
    Eigen::AlignedBox3f box;
    for (std::size_t t = first; t < end; ++t) {
      for (const Index v : triangles[t]) box.extend(places[v]);
    }
    chunks.push_back({box.center(), 0.5f * box.diagonal().norm()});
  }
  while (levels_.back().size() > kCellParts) {
    const std::vector<Sphere>& parts = levels_.back();
    std::vector<Sphere> cells;
    for (std::size_t first = 0; first < parts.size(); first += kCellParts) {
      const std::size_t end = std::min(first + kCellParts, parts.size());
      Eigen::AlignedBox3f centres;
      for (std::size_t i = first; i < end; ++i) centres.extend(parts[i].centre);
      Sphere cell{centres.center(), 0.0f};
      for (std::size_t i = first; i < end; ++i) {
        const float reach = (parts[i].centre - cell.centre).norm() + parts[i].radius_mm + kRoundingMm;
        cell.radius_mm = std::max(cell.radius_mm, reach);
      }
      cells.push_back(cell);
    }
    levels_.push_back(std::move(cells));
  }
}

struct SkinChunks::Question {
  Planes planes;
  std::span<const Influence> influences;
  bool cull;

  bool touches(const Sphere& sphere) const {
    return std::any_of(influences.begin(), influences.end(), [&](const Influence& influence) {
      return isNear(influence, sphere.centre, sphere.radius_mm + kTouchedDisplacementMm);
    });
  }
};

void SkinChunks::appendChunks(std::vector<IndexRun>& runs, std::size_t first_chunk, std::size_t end_chunk) {
  const auto first = static_cast<Index>(first_chunk) * kChunkIndices;
  append(runs, first, std::min(static_cast<Index>(end_chunk) * kChunkIndices, indices_) - first);
}

void SkinChunks::visit(const Question& question, std::size_t level, std::size_t node) {
  const Sphere& sphere = levels_[level][node];
  ++tested_;
  const float inside = question.cull ? insideBy(question.planes, sphere.centre) : sphere.radius_mm;
  if (!(inside > -(sphere.radius_mm + kMaxDisplacementMm))) return;
  const bool touched = question.touches(sphere);
  if (level == 0) return appendChunks(touched ? runs_.touched : runs_.plain, node, node + 1);
  std::size_t first = node, end = node + 1;
  if (!touched && inside > sphere.radius_mm - kMaxDisplacementMm) {  // nor is any chunk in it, and all are seen
    for (std::size_t i = 0; i < level; ++i) {
      first *= kCellParts;
      end *= kCellParts;
    }
    return appendChunks(runs_.plain, first, std::min(end, levels_[0].size()));
  }
  end = std::min(kCellParts * end, levels_[level - 1].size());
  for (std::size_t part = kCellParts * first; part < end; ++part) visit(question, level - 1, part);
}

const SplitRuns& SkinChunks::split(const Mat4f& clip, std::span<const Influence> influences, bool cull) {
  const Question question{planesOf(clip), influences, cull};
  runs_.touched.clear();
  runs_.plain.clear();
  tested_ = 0;
  const std::size_t top = levels_.size() - 1;
  for (std::size_t node = 0; node < levels_[top].size(); ++node) visit(question, top, node);
  return runs_;
}

}  // namespace palpate::view
