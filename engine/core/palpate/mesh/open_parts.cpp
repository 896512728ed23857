// Volume is the sum of tetrahedra over the triangles and the caps.
#include "palpate/mesh/open_parts.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>

#include "palpate/base/elementary.h"
#include "palpate/mesh/components.h"
#include "palpate/mesh/winding.h"

namespace palpate::mesh {

namespace {

/// Caps up to this share of the part's own area: a body with openings. A head cut at the neck has 0.05, a box without
/// its lid 0.2; a half ball has 0.5, a sheet about 1.
constexpr double kBodyCaps = 0.3;
/// Up to here it may be either, and an inward side is reported.
constexpr double kDoubtfulCaps = 0.6;
/// The volume against that of a ball of the same area: below it the sign is the accident of a crumpled sheet.
constexpr double kMinFullness = 0.01;
/// Triangles that all questions after the outer part together may look at.
constexpr std::size_t kMaxWork = 200'000'000;

/// An edge that a part uses more often one way than the other, as the part runs along it.
struct BorderEdge {
  Index part, from, to;
};

std::vector<BorderEdge> borderEdges(const TriangleMesh& mesh, const EdgeUses& edges, const Components& parts) {
  std::vector<BorderEdge> border;
  forEachEdge(edges, [&](Index low, Index high, std::span<const EdgeUse> uses) {
    int balance = edgeBalance(mesh, low, uses);
    const Index part = parts.of_triangle[uses[0].half_edge / 3];  // parts hang together across edges: one an edge
    for (; balance > 0; --balance) border.push_back({part, low, high});
    for (; balance < 0; ++balance) border.push_back({part, high, low});
  });
  return border;
}

/// Caps that close a part: volumes are about the part's own origin.
struct Caps {
  double area = 0.0;
  double volume = 0.0;
};

double tetrahedronVolume(const Vec3& a, const Vec3& b, const Vec3& c) { return a.dot(b.cross(c)) / 6.0; }

/// `origins`: one per part.
std::vector<Caps> capsOfParts(const TriangleMesh& mesh, const std::vector<BorderEdge>& border,
                              const std::vector<Vec3>& origins) {
  DisjointSets vertices(mesh.positions.size());
  for (const BorderEdge& edge : border) vertices.unite(edge.from, edge.to);
  std::vector<Vec3> sums(mesh.positions.size(), Vec3::Zero());
  std::vector<std::size_t> counts(mesh.positions.size(), 0);
  for (const BorderEdge& edge : border) {
    sums[vertices.root(edge.from)] += mesh.positions[edge.from];
    ++counts[vertices.root(edge.from)];
  }
  std::vector<Caps> caps(origins.size());
  for (const BorderEdge& edge : border) {
    const Index loop = vertices.root(edge.from);
    const Vec3 middle = sums[loop] / static_cast<double>(counts[loop]);
    const Vec3& origin = origins[edge.part];
    const Vec3 &from = mesh.positions[edge.from], &to = mesh.positions[edge.to];
    caps[edge.part].area += 0.5 * areaVector2(to, from, middle).norm();
    caps[edge.part].volume += tetrahedronVolume(to - origin, from - origin, middle - origin);
  }
  return caps;
}

/// Whether the rest of the mesh winds round the part: it is the wall of a hollow then.
bool liesInside(const TriangleMesh& mesh, const Components& parts, Index part, Index triangle) {
  std::vector<Index> others;
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    if (parts.of_triangle[t] != part) others.push_back(t);
  }
  return std::abs(windingNumber(mesh, others, centreOf(mesh, mesh.triangles[triangle]))) > 0.5;
}

}  // namespace

OpenParts findOpenParts(const TriangleMesh& mesh, const EdgeUses& edges) {
  OpenParts found;
  const Components parts = partsAcrossEdges(mesh, edges);
  const std::vector<BorderEdge> border = borderEdges(mesh, edges, parts);
  if (border.empty()) return found;
  std::vector<std::uint8_t> open(parts.count, 0);
  for (const BorderEdge& edge : border) open[edge.part] = 1;
  const IndexRows triangles = membersOfGroups(parts.of_triangle, parts.count);
  std::vector<Vec3> origins(parts.count);
  for (Index part = 0; part < parts.count; ++part) {
    origins[part] = mesh.positions[mesh.triangles[triangles[part][0]][0]];
  }
  const std::vector<Caps> caps = capsOfParts(mesh, border, origins);
  std::size_t work = 0;
  for (Index part = 0; part < parts.count; ++part) {
    if (open[part] == 0) continue;
    double volume = caps[part].volume;
    double area = 0.0;
    for (const Index t : triangles[part]) {
      const auto& [a, b, c] = mesh.triangles[t];
      const Vec3 &pa = mesh.positions[a], &pb = mesh.positions[b], &pc = mesh.positions[c];
      volume += tetrahedronVolume(pa - origins[part], pb - origins[part], pc - origins[part]);
      area += 0.5 * areaVector2(pa, pb, pc).norm();
    }
    const double ball = elementary::pow(area + caps[part].area, 1.5) / (6.0 * std::sqrt(std::numbers::pi));
    const bool faces_inwards = volume < -kMinFullness * ball && caps[part].area <= kDoubtfulCaps * area;
    if (faces_inwards) work += mesh.triangles.size();
    const bool is_outer =
        work <= kMaxWork && (parts.count == 1 || !faces_inwards || !liesInside(mesh, parts, part, triangles[part][0]));
    auto& kind = !faces_inwards || !is_outer          ? found.as_given
                 : caps[part].area > kBodyCaps * area ? found.doubtful
                                                      : found.inside_out;
    kind.emplace_back(triangles[part].begin(), triangles[part].end());
  }
  return found;
}

}  // namespace palpate::mesh
