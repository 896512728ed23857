// Parts of a mesh that share no vertex, the disjoint sets that find them, and the members of such parts.
//
// Read by repair and validate; `DisjointSets` also joins slivers, fans, sheets and borders there.
// Based on: Tarjan, van Leeuwen, "Worst-case analysis of set union algorithms", 1984 (path halving). The root of a set
// is its lowest element, so that results do not depend on the order of the pairs.
#pragma once

#include <cstddef>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/mesh/topology.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::mesh {

/// Groups of elements, united pair by pair.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), Index{0}); }

  /// The lowest element of the set.
  Index root(Index element) {
    while (parent_[element] != element) {
      parent_[element] = parent_[parent_[element]];
      element = parent_[element];
    }
    return element;
  }
  /// True when they were in two sets before.
  bool unite(Index a, Index b) {
    a = root(a);
    b = root(b);
    if (a == b) return false;
    if (a > b) std::swap(a, b);
    parent_[b] = a;
    return true;
  }

 private:
  std::vector<Index> parent_;
};

struct Components {
  std::vector<Index> of_triangle;  ///< numbered by their lowest triangle
  Index count = 0;
};

/// Vertices are united along every triangle, then triangles are numbered in order. Indices must be within range.
inline Components findComponents(const TriangleMesh& mesh) {
  DisjointSets vertices(mesh.positions.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    vertices.unite(a, b);
    vertices.unite(b, c);
  }
  Components components;
  std::vector<Index> number_of_root(mesh.positions.size(), kNoIndex);
  components.of_triangle.reserve(mesh.triangles.size());
  for (const Triangle& triangle : mesh.triangles) {
    Index& number = number_of_root[vertices.root(triangle[0])];
    if (number == kNoIndex) number = components.count++;
    components.of_triangle.push_back(number);
  }
  return components;
}

/// Parts that hang together across edges, of however many triangles; touching in a vertex does not join.
inline Components partsAcrossEdges(const TriangleMesh& mesh, const EdgeUses& edges) {
  DisjointSets triangles(mesh.triangles.size());
  forEachEdge(edges, [&](Index, Index, std::span<const EdgeUse> uses) {
    for (const EdgeUse& use : uses) triangles.unite(uses[0].half_edge / 3, use.half_edge / 3);
  });
  Components parts;
  parts.of_triangle.resize(mesh.triangles.size());
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    const Index root = triangles.root(t);  // the lowest: numbered before
    parts.of_triangle[t] = root == t ? parts.count++ : parts.of_triangle[root];
  }
  return parts;
}

/// The members of each group, ascending, where thing i belongs to group `of_thing[i]` < groups.
inline IndexRows membersOfGroups(std::span<const Index> of_thing, Index groups) {
  IndexRows members;
  members.offsets.assign(groups + std::size_t{1}, 0);
  for (const Index group : of_thing) ++members.offsets[group + 1];
  std::partial_sum(members.offsets.begin(), members.offsets.end(), members.offsets.begin());
  members.entries.resize(of_thing.size());
  std::vector<Index> next(members.offsets.begin(), members.offsets.end() - 1);
  for (Index i = 0; i < of_thing.size(); ++i) members.entries[next[of_thing[i]]++] = i;
  return members;
}

}  // namespace palpate::mesh
