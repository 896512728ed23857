// Marching tetrahedra on the Kuhn split of a cubic lattice, evaluated only in blocks near the surface.
//
// Each cube is cut into six tetrahedra around its main diagonal; the cut is the same in every cube, so faces match and
// the surface is a closed manifold for any field. (Marching cubes by table leaves non-manifold edges on thin plates.)
// Blocks are found by halving the box and dropping parts that are too far from the surface, then by following the
// surface across block faces, so that a wrong steepness bound cannot tear it.
//
// Relaxing is tangential Laplacian smoothing, with one projection by the field's value along the vertex normal a round.
//
// Based on: Kuhn, "Some combinatorial lemmas in topology" (1960), the split; Doi and Koide, "An efficient method of
// triangulating equi-valued surfaces by using tetrahedral cells" (1991); Ohtake and Belyaev, "Dual/primal mesh
// optimization for polygonized implicit surfaces" (2002), the idea of alternating a tangential move and a projection.
#include "palpate/body/tetrahedra_mesher.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <vector>

namespace palpate::body {
namespace {

using Point = Eigen::Vector3i;  // lattice coordinates

constexpr int kBlock = 4;  // cells along a block: small enough to hug the surface, large enough to amortise the queue
// A vertex stays this share of its edge away from the ends, so that no triangle shrinks to nothing.
constexpr double kEndShare = 0.02;

// One tetrahedron of a cube: corners 0 -> ... -> 7 as bit masks (1 = x, 2 = y, 4 = z), each adding one axis.
struct Tetrahedron {
  std::array<int, 4> corners;
  bool positive;  // orientation of the corners in this order
};
constexpr std::array<Tetrahedron, 6> kKuhnSplit = {{{{0, 1, 3, 7}, true},
                                                    {{0, 1, 5, 7}, false},
                                                    {{0, 2, 3, 7}, false},
                                                    {{0, 2, 6, 7}, true},
                                                    {{0, 4, 5, 7}, true},
                                                    {{0, 4, 6, 7}, false}}};

class Lattice {
 public:
  Lattice(const Field& field, const MesherSettings& settings) : field_(field), settings_(settings) {
    cells_ = ((settings.high - settings.low) / settings.cell_mm).array().ceil().max(1.0).cast<int>();
    points_ = cells_.array() + 1;
    blocks_ = (cells_.array() + kBlock - 1) / kBlock;
    values_.assign(static_cast<std::size_t>(points_.prod()), std::numeric_limits<double>::quiet_NaN());
    vertex_on_edge_.assign(8 * values_.size(), kNoIndex);
    queued_.assign(static_cast<std::size_t>(blocks_.prod()), 0);
  }

  mesh::TriangleMesh run() {
    seedBlocks(Point::Zero(), blocks_);
    while (!queue_.empty()) {
      const Point block = queue_.front();
      queue_.pop_front();
      visitBlock(block);
    }
    return std::move(mesh_);
  }

 private:
  // Queues the blocks of [low, high) that the surface may touch, halving the longest side.
  void seedBlocks(const Point& low, const Point& high) {
    const double half_diagonal = 0.5 * settings_.cell_mm * kBlock * (high - low).cast<double>().norm();
    if (std::abs(field_(position((low + high) * (kBlock / 2)))) > settings_.steepest * half_diagonal) return;
    int axis = 0;
    if ((high - low).maxCoeff(&axis) == 1) return queueBlock(low);
    Point middle = low;
    middle[axis] = (low[axis] + high[axis]) / 2;
    Point first_high = high;
    first_high[axis] = middle[axis];
    seedBlocks(low, first_high);
    seedBlocks(middle, high);
  }

  void queueBlock(const Point& block) {
    if ((block.array() < 0).any() || (block.array() >= blocks_.array()).any()) return;
    char& queued = queued_[flatIndex(block, blocks_)];
    if (queued == 0) queue_.push_back(block);
    queued = 1;
  }

  void visitBlock(const Point& block) {
    const Point low = block * kBlock;
    const Point high = (low.array() + kBlock).min(cells_.array());
    Point p;
    for (p.z() = low.z(); p.z() < high.z(); ++p.z()) {
      for (p.y() = low.y(); p.y() < high.y(); ++p.y()) {
        for (p.x() = low.x(); p.x() < high.x(); ++p.x()) visitCell(p, block);
      }
    }
  }

  void visitCell(const Point& cell, const Point& block) {
    const std::size_t base = index(cell);
    std::array<double, 8> value;
    int inside = 0;
    for (int corner = 0; corner < 8; ++corner) {
      value[corner] = valueAt(base, cell, corner);
      inside += value[corner] < 0.0 ? 1 : 0;
    }
    if (inside == 0 || inside == 8) return;
    followAcrossFaces(cell, block);
    for (const Tetrahedron& tetrahedron : kKuhnSplit) cutTetrahedron(tetrahedron, base, cell, value);
  }

  // A cut cell at the rim of its block: the surface may continue in the next block.
  void followAcrossFaces(const Point& cell, const Point& block) {
    for (int axis = 0; axis < 3; ++axis) {
      Point next = block;
      if (cell[axis] % kBlock == 0) next[axis] -= 1;
      if (cell[axis] % kBlock == kBlock - 1) next[axis] += 1;
      if (next != block) queueBlock(next);
    }
  }

  void cutTetrahedron(const Tetrahedron& t, std::size_t base, const Point& cell, const std::array<double, 8>& value) {
    std::array<int, 4> order;  // inside corners first, both groups ascending
    int inside = 0;
    for (int i = 0; i < 4; ++i) {
      if (value[t.corners[i]] < 0.0) order[inside++] = i;
    }
    if (inside == 0 || inside == 4) return;
    for (int i = 0, next = inside; i < 4; ++i) {
      if (value[t.corners[i]] >= 0.0) order[next++] = i;
    }
    const auto vertex = [&](int i, int j) {
      const auto [a, b] = std::minmax(t.corners[order[i]], t.corners[order[j]]);
      return vertexOnEdge(base, cell, a, b, value);
    };
    const bool flip = evenPermutation(order) != t.positive;
    // Vertices are numbered as they are made: in braces from the left, in parentheses as the compiler likes.
    const auto add = [&](const std::array<Index, 3>& last_first) {
      addTriangle(last_first[2], last_first[1], last_first[0], flip);
    };
    if (inside == 1) return add({vertex(0, 3), vertex(0, 2), vertex(0, 1)});
    if (inside == 3) return add({vertex(2, 3), vertex(1, 3), vertex(0, 3)});
    addQuad({vertex(0, 2), vertex(0, 3), vertex(1, 3), vertex(1, 2)}, flip);
  }

  static bool evenPermutation(const std::array<int, 4>& order) {
    int inversions = 0;
    for (int i = 0; i < 4; ++i) {
      for (int j = i + 1; j < 4; ++j) inversions += order[i] > order[j] ? 1 : 0;
    }
    return inversions % 2 == 0;
  }

  void addTriangle(Index a, Index b, Index c, bool flip) {
    if (flip) std::swap(b, c);
    mesh_.triangles.push_back({a, b, c});
  }

  // Splits along the shorter diagonal.
  void addQuad(const std::array<Index, 4>& q, bool flip) {
    const auto length = [&](int i, int j) { return (mesh_.positions[q[i]] - mesh_.positions[q[j]]).squaredNorm(); };
    const int first = length(0, 2) <= length(1, 3) ? 0 : 1;
    addTriangle(q[first], q[first + 1], q[first + 2], flip);
    addTriangle(q[first], q[first + 2], q[(first + 3) % 4], flip);
  }

  // The vertex on the edge from corner a to corner b of a cell; a is a subset of b, so (point a, b - a) names the edge.
  Index vertexOnEdge(std::size_t base, const Point& cell, int a, int b, const std::array<double, 8>& value) {
    Index& vertex = vertex_on_edge_[8 * (base + cornerOffset(a)) + static_cast<std::size_t>(b - a)];
    if (vertex == kNoIndex) {
      vertex = static_cast<Index>(mesh_.positions.size());
      mesh_.positions.push_back(
          crossing(position(cellCorner(cell, a)), position(cellCorner(cell, b)), value[a], value[b]));
    }
    return vertex;
  }

  // The zero of the field between two points: one secant step from the linear guess.
  Vec3 crossing(const Vec3& from, const Vec3& to, double value_from, double value_to) const {
    double t = value_from / (value_from - value_to);
    const double value = field_(from + t * (to - from));
    const bool beyond = (value < 0.0) == (value_from < 0.0);
    t = beyond ? t + (1.0 - t) * value / (value - value_to) : t * value_from / (value_from - value);
    return from + std::clamp(t, kEndShare, 1.0 - kEndShare) * (to - from);
  }

  double valueAt(std::size_t base, const Point& cell, int corner) {
    double& value = values_[base + cornerOffset(corner)];
    if (std::isnan(value)) value = field_(position(cellCorner(cell, corner)));
    return value;
  }

  static Point cellCorner(const Point& cell, int corner) {
    return cell + Point(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1);
  }
  std::size_t cornerOffset(int corner) const { return index(cellCorner(Point::Zero(), corner)); }
  std::size_t index(const Point& p) const { return flatIndex(p, points_); }
  static std::size_t flatIndex(const Point& p, const Point& size) {
    const auto wide = p.cast<std::size_t>();
    const auto extent = size.cast<std::size_t>();
    return wide.x() + extent.x() * (wide.y() + extent.y() * wide.z());
  }
  Vec3 position(const Point& p) const { return settings_.low + settings_.cell_mm * p.cast<double>(); }

  const Field& field_;
  const MesherSettings& settings_;
  Point cells_, points_, blocks_;
  std::vector<double> values_;         // NaN: not evaluated yet
  std::vector<Index> vertex_on_edge_;  // 8 slots a lattice point, slot = axes of the edge as a mask
  std::vector<char> queued_;
  std::deque<Point> queue_;
  mesh::TriangleMesh mesh_;
};

// --- relaxing ---

constexpr double kStep = 0.6;  // share of the way to the neighbours' middle; 1 would overshoot on stretched fans

struct Surroundings {
  Vec3 corner_sum = Vec3::Zero();  // sum of the other two corners of each triangle
  Vec3 area_sum = Vec3::Zero();
  int corners = 0;
};

std::vector<Surroundings> gather(const mesh::TriangleMesh& mesh) {
  std::vector<Surroundings> around(mesh.positions.size());
  for (const Triangle& t : mesh.triangles) {
    const Vec3& a = mesh.positions[t[0]];
    const Vec3& b = mesh.positions[t[1]];
    const Vec3& c = mesh.positions[t[2]];
    const Vec3 area = mesh::areaVector2(a, b, c);
    const Vec3 sum = a + b + c;
    for (const Index v : t) {
      around[v].corner_sum += sum - mesh.positions[v];
      around[v].area_sum += area;
      around[v].corners += 2;
    }
  }
  return around;
}

Vec3 moved(const Vec3& p, const Surroundings& around, const Field& field) {
  const bool in_plane = p.x() == 0.0;
  Vec3 normal = around.area_sum;
  Vec3 shift = around.corner_sum / std::max(around.corners, 1) - p;
  if (in_plane) normal.x() = shift.x() = 0.0;
  normal = normal.stableNormalized();
  shift -= normal.dot(shift) * normal;
  const Vec3 there = p + kStep * shift;
  // No projection is longer than the move before it could have needed.
  const double reach = 0.5 * shift.norm() + 0.1;
  return there - std::clamp(field(there), -reach, reach) * normal;
}

}  // namespace

mesh::TriangleMesh meshZeroSurface(const Field& field, const MesherSettings& settings) {
  return Lattice(field, settings).run();
}

void relaxOnSurface(mesh::TriangleMesh& mesh, const Field& field, int rounds) {
  for (int round = 0; round < rounds; ++round) {
    const std::vector<Surroundings> around = gather(mesh);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      mesh.positions[v] = moved(mesh.positions[v], around[v], field);
    }
  }
}

mesh::TriangleMesh relaxedZeroSurface(const Field& field, const MesherSettings& settings, int rounds) {
  mesh::TriangleMesh mesh = meshZeroSurface(field, settings);
  relaxOnSurface(mesh, field, rounds);
  return mesh;
}

mesh::TriangleMesh inFrame(const Eigen::Isometry3d& frame, mesh::TriangleMesh mesh) {
  for (Vec3& p : mesh.positions) p = frame * p;
  return mesh;
}

mesh::TriangleMesh mirrored(mesh::TriangleMesh mesh) {
  for (Vec3& p : mesh.positions) p = mirrored(p);
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

mesh::TriangleMesh withMirrorImage(mesh::TriangleMesh half) {
  const std::size_t vertices = half.positions.size();
  const std::size_t triangles = half.triangles.size();
  std::vector<Index> image(vertices);
  for (std::size_t v = 0; v < vertices; ++v) {
    const Vec3 p = half.positions[v];
    image[v] = p.x() == 0.0 ? static_cast<Index>(v) : static_cast<Index>(half.positions.size());
    if (p.x() != 0.0) half.positions.push_back(mirrored(p));
  }
  for (std::size_t t = 0; t < triangles; ++t) {
    const Triangle original = half.triangles[t];
    half.triangles.push_back({image[original[0]], image[original[2]], image[original[1]]});
  }
  return half;
}

}  // namespace palpate::body
