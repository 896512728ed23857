// Last step of the outline mesher: gives the triangles near the border a better shape, without changing their number.
//
// Flips by the empty-circle rule and moves vertices to the middle of their neighbours, only where that helps.
//
// Based on: Lawson, "Software for C1 surface interpolation" (1977) for the flips; Freitag, "On combining Laplacian and
// optimization-based mesh smoothing techniques" (1997) for accepting a move only when the worst angle grows.
#include <algorithm>
#include <numbers>
#include <span>
#include <vector>

#include "palpate/base/elementary.h"
#include "palpate/body/outline_mesher.h"
#include "palpate/mesh/topology.h"

namespace palpate::body {

namespace {

constexpr int kRings = 4;   // how far from the border triangles are looked at: the band and three rings of the lattice
constexpr int kRounds = 6;  // more rounds no longer change the worst angle

/// The part of the mesh near the border, with numbers of its own.
struct Band {
  mesh::TriangleMesh lifted;  ///< positions in space
  std::vector<Vec2> flat;
  std::vector<char> fixed;      ///< border vertices, and those shared with triangles outside the band
  std::vector<Index> vertex;    ///< number in the whole mesh
  std::vector<Index> triangle;  ///< number in the whole mesh
};

/// Marks the vertices within `rings` edges of the border.
std::vector<char> nearBorder(const FlatMesh& mesh, int rings) {
  std::vector<char> near(mesh.points.size(), 0);
  std::fill_n(near.begin(), mesh.border, 1);
  for (int ring = 0; ring < rings; ++ring) {
    std::vector<Index> reached;
    for (const Triangle& corners : mesh.triangles) {
      if (near[corners[0]] + near[corners[1]] + near[corners[2]] == 0) continue;
      for (const Index corner : corners) {
        if (!near[corner]) reached.push_back(corner);
      }
    }
    for (const Index corner : reached) near[corner] = 1;
  }
  return near;
}

Band cutBand(const FlatMesh& mesh, const Lift& lift) {
  const std::vector<char> near = nearBorder(mesh, kRings);
  std::vector<Index> number(mesh.points.size(), kNoIndex);
  std::vector<char> outside(mesh.points.size(), 0);
  Band band;
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& corners = mesh.triangles[t];
    const bool inside = near[corners[0]] && near[corners[1]] && near[corners[2]];
    if (inside) band.triangle.push_back(t);
    if (!inside) {
      for (const Index corner : corners) outside[corner] = 1;
    }
  }
  for (const Index t : band.triangle) {
    Triangle local;
    for (int i = 0; i < 3; ++i) {
      const Index corner = mesh.triangles[t][i];
      if (number[corner] == kNoIndex) {
        number[corner] = static_cast<Index>(band.vertex.size());
        band.vertex.push_back(corner);
        band.flat.push_back(mesh.points[corner]);
        band.lifted.positions.push_back(lift(mesh.points[corner]));
        band.fixed.push_back(corner < mesh.border || outside[corner]);
      }
      local[i] = number[corner];
    }
    band.lifted.triangles.push_back(local);
  }
  return band;
}

double flatArea2(const Band& band, Index a, Index b, Index c) {
  const Vec2 u = band.flat[b] - band.flat[a];
  const Vec2 v = band.flat[c] - band.flat[a];
  return u.x() * v.y() - u.y() * v.x();
}

double angleAt(const Vec3& corner, const Vec3& a, const Vec3& b) {
  const Vec3 u = a - corner;
  const Vec3 v = b - corner;
  return elementary::atan2(u.cross(v).norm(), u.dot(v));
}

int edgeFacing(const std::array<Index, 3>& neighbours, Index triangle) {
  for (int edge = 0; edge < 3; ++edge) {
    if (neighbours[edge] == triangle) return edge;
  }
  return -1;
}

/// The two triangles at edge `edge` of `t` and the four corners of the quadrilateral they make.
struct Quad {
  Index t, other;
  int edge, other_edge;
  Index a, b, c, d;  ///< t = (a, b, c), other = (b, a, d); the shared edge is a b
};

Quad quadAt(const Band& band, std::span<const std::array<Index, 3>> neighbours, Index t, int edge) {
  const Index other = neighbours[t][edge];
  const int other_edge = edgeFacing(neighbours[other], t);
  const Triangle& here = band.lifted.triangles[t];
  const Triangle& there = band.lifted.triangles[other];
  return {.t = t,
          .other = other,
          .edge = edge,
          .other_edge = other_edge,
          .a = here[edge],
          .b = here[(edge + 1) % 3],
          .c = here[(edge + 2) % 3],
          .d = there[(other_edge + 2) % 3]};
}

/// True when the other diagonal gives rounder triangles: the angles facing the shared edge sum to more than pi.
bool shouldFlip(const Band& band, const Quad& quad) {
  if (flatArea2(band, quad.c, quad.d, quad.b) <= 0 || flatArea2(band, quad.d, quad.c, quad.a) <= 0) return false;
  // Where the border turns sharply the band may hold a triangle that is turned over: any other diagonal is better.
  if (flatArea2(band, quad.a, quad.b, quad.c) <= 0 || flatArea2(band, quad.b, quad.a, quad.d) <= 0) return true;
  const auto& at = band.lifted.positions;
  constexpr double kSlack = 1e-6;  // rad; keeps two equal diagonals from flipping for ever
  return angleAt(at[quad.c], at[quad.a], at[quad.b]) + angleAt(at[quad.d], at[quad.a], at[quad.b]) >
         std::numbers::pi + kSlack;
}

void replaceNeighbour(std::vector<std::array<Index, 3>>& neighbours, Index triangle, Index before, Index after) {
  if (triangle == kNoIndex) return;
  neighbours[triangle][edgeFacing(neighbours[triangle], before)] = after;
}

/// (a, b, c), (b, a, d) become (c, d, b), (d, c, a).
void flip(Band& band, std::vector<std::array<Index, 3>>& neighbours, const Quad& quad) {
  const Index bc = neighbours[quad.t][(quad.edge + 1) % 3];
  const Index ca = neighbours[quad.t][(quad.edge + 2) % 3];
  const Index ad = neighbours[quad.other][(quad.other_edge + 1) % 3];
  const Index db = neighbours[quad.other][(quad.other_edge + 2) % 3];
  band.lifted.triangles[quad.t] = {quad.c, quad.d, quad.b};
  band.lifted.triangles[quad.other] = {quad.d, quad.c, quad.a};
  neighbours[quad.t] = {quad.other, db, bc};
  neighbours[quad.other] = {quad.t, ca, ad};
  replaceNeighbour(neighbours, db, quad.other, quad.t);
  replaceNeighbour(neighbours, ca, quad.t, quad.other);
}

/// Flips until no edge wants to; the number of sweeps is bounded, for rounding could make two edges disagree.
void flipEdges(Band& band) {
  auto neighbours = mesh::neighboursOfTriangles(band.lifted);
  constexpr int kSweeps = 30;
  bool changed = true;
  for (int sweep = 0; sweep < kSweeps && changed; ++sweep) {
    changed = false;
    for (Index t = 0; t < neighbours.size(); ++t) {
      for (int edge = 0; edge < 3; ++edge) {
        if (neighbours[t][edge] == kNoIndex) continue;
        const Quad quad = quadAt(band, neighbours, t, edge);
        if (!shouldFlip(band, quad)) continue;
        flip(band, neighbours, quad);
        changed = true;
      }
    }
  }
}

/// The smallest angle of the lifted triangles round a vertex; negative if one is turned over in the plane.
double worstAngle(const Band& band, std::span<const Index> triangles) {
  double worst = 4;
  for (const Index t : triangles) {
    const auto& [a, b, c] = band.lifted.triangles[t];
    if (flatArea2(band, a, b, c) <= 0) return -1;
    const auto& at = band.lifted.positions;
    worst = std::min({worst, angleAt(at[a], at[b], at[c]), angleAt(at[b], at[c], at[a]), angleAt(at[c], at[a], at[b])});
  }
  return worst;
}

Vec2 middleOfNeighbours(const Band& band, Index vertex, std::span<const Index> triangles) {
  Vec2 sum = Vec2::Zero();
  for (const Index t : triangles) {
    for (const Index corner : band.lifted.triangles[t]) {
      if (corner != vertex) sum += band.flat[corner];
    }
  }
  return sum / (2.0 * static_cast<double>(triangles.size()));
}

void moveVertices(Band& band, const Lift& lift) {
  const mesh::IndexRows around = mesh::trianglesOfVertices(band.lifted);
  for (Index vertex = 0; vertex < band.flat.size(); ++vertex) {
    if (band.fixed[vertex]) continue;
    const Vec2 flat_before = band.flat[vertex];
    const Vec3 lifted_before = band.lifted.positions[vertex];
    const double angle_before = worstAngle(band, around[vertex]);
    band.flat[vertex] = middleOfNeighbours(band, vertex, around[vertex]);
    band.lifted.positions[vertex] = lift(band.flat[vertex]);
    if (worstAngle(band, around[vertex]) > angle_before) continue;
    band.flat[vertex] = flat_before;
    band.lifted.positions[vertex] = lifted_before;
  }
}

void putBack(const Band& band, FlatMesh& mesh) {
  for (std::size_t i = 0; i < band.vertex.size(); ++i) mesh.points[band.vertex[i]] = band.flat[i];
  for (std::size_t i = 0; i < band.triangle.size(); ++i) {
    const Triangle& local = band.lifted.triangles[i];
    mesh.triangles[band.triangle[i]] = {band.vertex[local[0]], band.vertex[local[1]], band.vertex[local[2]]};
  }
}

}  // namespace

void improveBand(FlatMesh& mesh, const Lift& lift) {
  Band band = cutBand(mesh, lift);
  for (int round = 0; round < kRounds; ++round) {
    flipEdges(band);
    moveVertices(band, lift);
  }
  flipEdges(band);
  putBack(band, mesh);
}

}  // namespace palpate::body
