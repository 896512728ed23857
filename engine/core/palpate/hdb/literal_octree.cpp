// Grows the octree of the printed rule and counts the lost triangles.
//
// Data flow: mesh -> here -> LiteralOctree -> studies and the scenes that ask for E6.
// Based on: Ji, dissertation 2008, 3.4 to the letter (E6).
#include "palpate/hdb/literal_octree.h"

#include <algorithm>
#include <array>
#include <utility>

#include "palpate/hdb/detail/growth.h"

namespace palpate::hdb {

namespace {

int octantIndex(const Vec3& point, const Vec3& at) {
  return (point.x() >= at.x() ? 1 : 0) + (point.y() >= at.y() ? 2 : 0) + (point.z() >= at.z() ? 4 : 0);  // E9
}

struct Traveller {
  Index triangle;
  bool lost;  // at a node above
};

class LiteralGrowth {
 public:
  LiteralGrowth(Growth& growth, const mesh::TriangleMesh& mesh)
      : growth_(growth), mesh_(mesh), share_(1.0 / static_cast<double>(mesh.triangles.size())) {}

  void grow(Index node, const std::vector<Traveller>& travellers) {
    const bool small = travellers.size() <= growth_.most_in_leaf;
    if (small || growth_.nodes[node].level >= kMaxOctreeLevels || allEqual(travellers)) {
      fillLeaf(node, travellers);
      return;
    }
    const std::array<std::vector<Traveller>, 8> octants = divide(node, travellers);
    std::vector<std::uint8_t> slots;
    for (std::uint8_t o = 0; o < 8; ++o) {
      if (!octants[o].empty()) slots.push_back(o);
    }
    Index child = addChildren(growth_, node, slots);
    for (const std::uint8_t o : slots) grow(child++, octants[o]);
  }

 private:
  /// As in the majority rule: no plane separates coincident triangles (E7).
  bool allEqual(const std::vector<Traveller>& travellers) const {
    const Vec3 first = middlePoint(mesh_, travellers.front().triangle);
    return std::ranges::all_of(travellers, [&](const Traveller& t) { return middlePoint(mesh_, t.triangle) == first; });
  }

  Piece cornersOf(Index triangle) const {
    const auto [a, b, c] = mesh_.triangles[triangle];
    return {mesh_.positions[a], mesh_.positions[b], mesh_.positions[c]};
  }

  /// Where two of three vertices agree on an octant, it is also that of the majority by axes.
  std::array<std::vector<Traveller>, 8> divide(Index node, const std::vector<Traveller>& travellers) const {
    std::array<std::vector<Traveller>, 8> octants;
    const Vec3 at = splitPoint(growth_.cells[node]);
    for (const Traveller& traveller : travellers) {
      const Piece corners = cornersOf(traveller.triangle);
      const int a = octantIndex(corners[0], at), b = octantIndex(corners[1], at), c = octantIndex(corners[2], at);
      const int majority = (a & b) | (b & c) | (c & a);
      const bool in_three = a != b && b != c && c != a;
      octants[majority].push_back({traveller.triangle, traveller.lost || in_three});
    }
    return octants;
  }

  void fillLeaf(Index node, const std::vector<Traveller>& travellers) {
    const std::size_t first = growth_.items.size();
    for (const Traveller& traveller : travellers) {
      if (traveller.lost) continue;
      const Piece corners = cornersOf(traveller.triangle);
      growth_.items.push_back({(corners[0] + corners[1] + corners[2]) / 3.0, traveller.triangle, 0});
    }
    const double share = share_ * static_cast<double>(travellers.size());
    makeLeaf(growth_, node, first, growth_.items.size() - first, share);
  }

  Growth& growth_;
  const mesh::TriangleMesh& mesh_;
  double share_;  // share of the progress per triangle
};

std::vector<Traveller> allTriangles(const mesh::TriangleMesh& mesh) {
  std::vector<Traveller> all;
  all.reserve(mesh.triangles.size());
  for (Index t = 0; t < mesh.triangles.size(); ++t) all.push_back({t, false});
  return all;
}

std::vector<Index> missingFrom(const Partition& partition) {
  std::vector<bool> stored(partition.triangle_count, false);
  for (const Index triangle : partition.triangles) stored[triangle] = true;
  std::vector<Index> missing;
  for (Index t = 0; t < stored.size(); ++t) {
    if (!stored[t]) missing.push_back(t);
  }
  return missing;
}

}  // namespace

LiteralOctree buildLiteralOctree(const mesh::TriangleMesh& mesh, const BuildSettings& settings,
                                 const Progress& progress) {
  BuildSettings octree = settings;
  octree.tree = TreeKind::Octree;
  Growth growth = startGrowth(mesh, octree, progress);
  if (!mesh.triangles.empty()) LiteralGrowth(growth, mesh).grow(0, allTriangles(mesh));
  LiteralOctree literal;
  literal.partition = finishPartition(std::move(growth), mesh, Assignment::Majority);
  literal.lost = missingFrom(literal.partition);
  return literal;
}

}  // namespace palpate::hdb
