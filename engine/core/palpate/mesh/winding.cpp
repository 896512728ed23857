// Patches grow breadth first across edges; a closed one with a negative volume is turned unless it lies inside another,
// by the winding number at one of its corners. Volumes are sums of tetrahedra, winding numbers of solid angles.
//
// Based on: Van Oosterom, Strackee, "The solid angle of a plane triangle", 1983; Jacobson, Kavan, Sorkine-Hornung,
// "Robust inside-outside segmentation using generalized winding numbers", 2013 (inside = winding number above a half).
#include "palpate/mesh/winding.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "palpate/base/elementary.h"
#include "palpate/mesh/components.h"

namespace palpate::mesh {

namespace {

/// The half-edge across, where an edge has exactly two, whatever their directions.
std::vector<Index> pairedHalfEdges(const TriangleMesh& mesh, const EdgeUses& edges) {
  std::vector<Index> across(mesh.triangles.size() * 3, kNoIndex);
  forEachEdge(edges, [&](Index, Index, std::span<const EdgeUse> uses) {
    if (uses.size() != 2) return;
    across[uses[0].half_edge] = uses[1].half_edge;
    across[uses[1].half_edge] = uses[0].half_edge;
  });
  return across;
}

bool sameDirection(const TriangleMesh& mesh, Index half_edge, Index other) {
  return halfEdgeStart(mesh, half_edge) == halfEdgeStart(mesh, other);
}

/// Marks the patch of `seed` and which of its triangles must flip to agree with the seed.
void growPatch(const TriangleMesh& mesh, const std::vector<Index>& across, Index seed, Patches& patches,
               std::vector<Index>& members) {
  members.assign(1, seed);
  patches.of_triangle[seed] = patches.count;
  for (std::size_t next = 0; next < members.size(); ++next) {
    for (Index h = 3 * members[next]; h < 3 * members[next] + 3; ++h) {
      if (across[h] == kNoIndex || patches.of_triangle[across[h] / 3] != kNoIndex) continue;
      const Index neighbour = across[h] / 3;
      patches.of_triangle[neighbour] = patches.count;
      patches.flipped[neighbour] = patches.flipped[members[next]] != sameDirection(mesh, h, across[h]);
      members.push_back(neighbour);
    }
  }
  ++patches.count;
}

/// The smaller half is the one to flip; the seed's half stays on a tie.
void preferMajority(Patches& patches, const std::vector<Index>& members) {
  const auto flips = std::count_if(members.begin(), members.end(), [&](Index t) { return patches.flipped[t]; });
  if (2 * static_cast<std::size_t>(flips) <= members.size()) return;
  for (Index t : members) patches.flipped[t] = !patches.flipped[t];
}

std::size_t countSeamEdges(const TriangleMesh& mesh, const std::vector<Index>& across, const Patches& patches) {
  std::size_t count = 0;
  for (Index h = 0; h < across.size(); ++h) {
    if (across[h] == kNoIndex || across[h] < h) continue;
    const bool both_or_none = patches.flipped[h / 3] == patches.flipped[across[h] / 3];
    if (sameDirection(mesh, h, across[h]) == both_or_none) ++count;
  }
  return count;
}

void flip(Triangle& t) { std::swap(t[1], t[2]); }

// --- outwards ---

/// Triangles that are turned together, and whether each of these units is closed: a closed patch, or the rest of a
/// closed part without its closed patches.
struct Units {
  std::vector<Index> of_triangle;
  Index count = 0;
  std::vector<bool> closed;
};

/// A group is closed when at each of its edges as many of its triangles run one way as the other.
std::vector<bool> closedGroups(const TriangleMesh& mesh, const EdgeUses& edges, std::span<const Index> group_of,
                               Index groups) {
  std::vector<bool> closed(groups, true);
  std::vector<std::pair<Index, int>> directions;
  forEachEdge(edges, [&](Index low, Index, std::span<const EdgeUse> uses) {
    directions.clear();
    for (const EdgeUse& use : uses) {
      const int direction = halfEdgeStart(mesh, use.half_edge) == low ? 1 : -1;
      directions.emplace_back(group_of[use.half_edge / 3], direction);
    }
    std::sort(directions.begin(), directions.end());
    for (std::size_t i = 0; i < directions.size();) {
      const Index group = directions[i].first;
      int balance = 0;
      for (; i < directions.size() && directions[i].first == group; ++i) balance += directions[i].second;
      if (balance != 0) closed[group] = false;
    }
  });
  return closed;
}

bool anyNonManifoldEdge(const EdgeUses& edges) {
  bool any = false;
  forEachEdge(edges, [&](Index, Index, std::span<const EdgeUse> uses) { any |= uses.size() > 2; });
  return any;
}

/// Patches that only a whole part closes are one unit: each of them has no inside, and turning one would open the part.
Units findUnits(const TriangleMesh& mesh, const EdgeUses& edges, const Patches& patches) {
  Units units{patches.of_triangle, patches.count, closedGroups(mesh, edges, patches.of_triangle, patches.count)};
  if (!anyNonManifoldEdge(edges)) return units;
  const Components parts = partsAcrossEdges(mesh, edges);
  const std::vector<bool> part_closed = closedGroups(mesh, edges, parts.of_triangle, parts.count);
  std::vector<Index> rest_of_part(parts.count, kNoIndex);
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    const Index part = parts.of_triangle[t];
    if (!part_closed[part] || units.closed[patches.of_triangle[t]]) continue;
    if (rest_of_part[part] == kNoIndex) rest_of_part[part] = units.count++;
    units.of_triangle[t] = rest_of_part[part];
  }
  units.closed.resize(units.count, true);
  return units;
}

/// Six times the volume of the tetrahedron between a triangle and the origin.
double volume6(const TriangleMesh& mesh, const Triangle& t, const Vec3& origin) {
  return (mesh.positions[t[0]] - origin).dot((mesh.positions[t[1]] - origin).cross(mesh.positions[t[2]] - origin));
}

double enclosedVolume(const TriangleMesh& mesh, std::span<const Index> triangles, const Vec3& origin) {
  double six_times = 0.0;
  for (const Index t : triangles) six_times += volume6(mesh, mesh.triangles[t], origin);
  return six_times / 6.0;
}

/// Closed units with their boxes, to find which is inside which.
class ClosedParts {
 public:
  ClosedParts(const TriangleMesh& mesh, const IndexRows& triangles, const std::vector<bool>& closed)
      : mesh_(mesh), triangles_(triangles), closed_(closed), boxes_(triangles.rows()) {
    unit_of_vertex_.assign(mesh.positions.size(), kNoIndex);
    for (Index u = 0; u < triangles.rows(); ++u) {
      for (Index t : triangles[u]) {
        for (Index v : mesh.triangles[t]) add(v, u);
      }
    }
    work_left_ = 64 * mesh.triangles.size() + 1'000'000;
  }

  const Eigen::AlignedBox3d& box(Index unit) const { return boxes_[unit]; }

  bool isInsideAnother(Index unit) {
    const Vec3 point = ownPoint(unit);
    for (Index other = 0; other < triangles_.rows() && work_left_ > 0; ++other) {
      --work_left_;
      if (other == unit || !closed_[other] || !boxes_[other].contains(boxes_[unit])) continue;
      work_left_ -= std::min(work_left_, triangles_[other].size());
      if (std::abs(windingNumber(mesh_, triangles_[other], point)) > 0.5) return true;
    }
    return false;
  }

  /// Whether the whole mesh, as it is wound, has its outside in front of the unit and its inside behind: the wall of a
  /// hollow, even of one that several units enclose together (voxels that meet in edges).
  bool isSoundWall(Index unit) {
    const Triangle& t = mesh_.triangles[triangles_[unit][0]];
    const Vec3 normal = areaVector2(mesh_, t).stableNormalized();
    const Vec3 off = kOffTheWall * boxes_[unit].diagonal().norm() * normal;
    work_left_ -= std::min(work_left_, 2 * mesh_.triangles.size());
    const Vec3 centre = centreOf(mesh_, t);
    return std::abs(windingNumber(mesh_, triangles_.entries, centre + off)) < 0.25 &&
           windingNumber(mesh_, triangles_.entries, centre - off) > 0.75;
  }

 private:
  static constexpr double kOffTheWall = 1e-6;  // times its size
  static constexpr Index kSeveral = kNoIndex - 1;

  void add(Index vertex, Index unit) {
    boxes_[unit].extend(mesh_.positions[vertex]);
    Index& owner = unit_of_vertex_[vertex];
    owner = owner == kNoIndex || owner == unit ? unit : kSeveral;
  }

  /// A corner that no other unit has: where units touch, a winding number has no value.
  Vec3 ownPoint(Index unit) const {
    for (Index t : triangles_[unit]) {
      for (Index v : mesh_.triangles[t]) {
        if (unit_of_vertex_[v] == unit) return mesh_.positions[v];
      }
    }
    return centreOf(mesh_, mesh_.triangles[triangles_[unit][0]]);
  }

  const TriangleMesh& mesh_;
  const IndexRows& triangles_;
  const std::vector<bool>& closed_;
  std::vector<Eigen::AlignedBox3d> boxes_;
  std::vector<Index> unit_of_vertex_;  // kSeveral: units touch there
  /// Thousands of nested shells would cost the square of their number; beyond this the rest counts as not nested.
  std::size_t work_left_ = 0;
};

}  // namespace

Patches findPatches(const TriangleMesh& mesh, const EdgeUses& edges) {
  Patches patches;
  patches.of_triangle.assign(mesh.triangles.size(), kNoIndex);
  patches.flipped.assign(mesh.triangles.size(), false);
  const std::vector<Index> across = pairedHalfEdges(mesh, edges);
  std::vector<Index> members;
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    if (patches.of_triangle[t] != kNoIndex) continue;
    growPatch(mesh, across, t, patches, members);
    preferMajority(patches, members);
  }
  patches.seam_edges = countSeamEdges(mesh, across, patches);
  return patches;
}

std::size_t makeWindingConsistent(TriangleMesh& mesh, const Patches& patches) {
  std::size_t count = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!patches.flipped[t]) continue;
    flip(mesh.triangles[t]);
    ++count;
  }
  return count;
}

std::size_t turnOutwards(TriangleMesh& mesh, const EdgeUses& edges, const Patches& patches) {
  const Units units = findUnits(mesh, edges, patches);
  const IndexRows triangles = membersOfGroups(units.of_triangle, units.count);
  ClosedParts parts(mesh, triangles, units.closed);
  std::vector<Index> inside_out;
  for (Index u = 0; u < units.count; ++u) {
    if (!units.closed[u] || triangles[u].empty()) continue;
    if (enclosedVolume(mesh, triangles[u], parts.box(u).center()) >= 0.0 || parts.isInsideAnother(u) ||
        parts.isSoundWall(u)) {
      continue;
    }
    inside_out.push_back(u);
  }
  for (Index u : inside_out) {
    for (Index t : triangles[u]) flip(mesh.triangles[t]);
  }
  return inside_out.size();
}

double windingNumber(const TriangleMesh& mesh, std::span<const Index> triangles, const Vec3& point) {
  double half_angles = 0.0;
  for (Index t : triangles) {
    const Vec3 a = mesh.positions[mesh.triangles[t][0]] - point;
    const Vec3 b = mesh.positions[mesh.triangles[t][1]] - point;
    const Vec3 c = mesh.positions[mesh.triangles[t][2]] - point;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    half_angles += elementary::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return half_angles / (2.0 * std::numbers::pi);
}

double signedVolume(const TriangleMesh& mesh) {
  const Vec3 origin = mesh.positions.empty() ? Vec3::Zero().eval() : mesh.positions[0];
  double six_times = 0.0;
  for (const Triangle& t : mesh.triangles) six_times += volume6(mesh, t, origin);
  return six_times / 6.0;
}

}  // namespace palpate::mesh
