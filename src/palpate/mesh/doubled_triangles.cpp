// Triangles over the same vertices are found by sorting within the row of their lowest vertex; opposite pairs that hang
// together are one sheet, and how its rim meets the rest of the surface says what becomes of it. Own.
#include "palpate/mesh/doubled_triangles.h"

#include <algorithm>
#include <array>

#include "palpate/mesh/components.h"
#include "palpate/mesh/topology.h"

namespace palpate::mesh {

namespace {

Triangle sorted(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

bool hasThreeVertices(const Triangle& t) { return t[0] != t[1] && t[1] != t[2] && t[2] != t[0]; }

/// Triangles filed under their lowest vertex.
IndexRows trianglesByLowestVertex(const TriangleMesh& mesh) {
  std::vector<Index> lowest;
  lowest.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) lowest.push_back(*std::min_element(t.begin(), t.end()));
  return membersOfGroups(lowest, static_cast<Index>(mesh.positions.size()));
}

void removeMarked(TriangleMesh& mesh, const std::vector<bool>& marked) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!marked[t]) mesh.triangles[kept++] = mesh.triangles[t];
  }
  mesh.triangles.resize(kept);
}

std::size_t removeDuplicates(TriangleMesh& mesh) {
  std::vector<bool> marked(mesh.triangles.size(), false);
  std::size_t count = 0;
  for (const TwinGroup& group : twinGroups(mesh)) {
    std::array<bool, 2> seen{};
    for (Index t : group) {
      bool& same_winding_seen = seen[runsUp(mesh.triangles[t]) ? 1 : 0];
      if (same_winding_seen) {
        marked[t] = true;
        ++count;
      }
      same_winding_seen = true;
    }
  }
  if (count > 0) removeMarked(mesh, marked);
  return count;
}

/// How a connected sheet of opposite pairs meets the rest of the surface.
struct Rim {
  bool has_free_edge = false;  ///< an edge of one pair and of nothing else
  bool on_surface = false;     ///< an edge where the rest is complete without the sheet: it stands on it
  bool fills_hole = false;     ///< an edge that the rest leaves open
};

class OppositePairs {
 public:
  OppositePairs(const TriangleMesh& mesh, std::vector<TwinGroup> pairs)
      : mesh_(mesh), pairs_(std::move(pairs)), pair_of_(mesh.triangles.size(), kNoIndex), sheets_(pairs_.size()) {
    for (Index p = 0; p < pairs_.size(); ++p) {
      for (Index t : pairs_[p]) pair_of_[t] = p;
    }
  }

  /// Marks what goes and counts it.
  DoubledRemoved choose(std::vector<bool>& marked) {
    const bool all_doubled = 2 * pairs_.size() == mesh_.triangles.size();
    const std::vector<Rim> rims = rimsOfSheets();
    DoubledRemoved removed;
    for (Index p = 0; p < pairs_.size(); ++p) {
      const Rim& rim = rims[sheets_.root(p)];
      const bool is_needed = all_doubled || (rim.fills_hole && !rim.on_surface && !rim.has_free_edge);
      marked[pairs_[p][0]] = !is_needed;
      marked[pairs_[p][1]] = true;
      ++(is_needed ? removed.sides : removed.opposite_pairs);
    }
    return removed;
  }

 private:
  std::vector<Rim> rimsOfSheets() {
    const EdgeUses edges = edgeUses(mesh_);
    forEachEdge(edges, [&](Index, Index, std::span<const EdgeUse> uses) {
      const auto [pairs, others] = countAt(uses);
      if (others == 0 && pairs > 1) uniteAt(uses);
    });
    std::vector<Rim> rims(pairs_.size());
    forEachEdge(edges, [&](Index, Index, std::span<const EdgeUse> uses) {
      const auto [pairs, others] = countAt(uses);
      for (const EdgeUse& use : uses) {
        if (pair_of_[use.half_edge / 3] == kNoIndex) continue;
        Rim& rim = rims[sheets_.root(pair_of_[use.half_edge / 3])];
        rim.has_free_edge |= others == 0 && pairs == 1;
        rim.on_surface |= others > 0 && others % 2 == 0;
        rim.fills_hole |= others % 2 == 1;
      }
    });
    return rims;
  }

  struct EdgeCount {
    std::size_t pairs;
    std::size_t others;
  };
  EdgeCount countAt(std::span<const EdgeUse> uses) const {
    const auto in_pairs = static_cast<std::size_t>(std::count_if(
        uses.begin(), uses.end(), [&](const EdgeUse& use) { return pair_of_[use.half_edge / 3] != kNoIndex; }));
    return {in_pairs / 2, uses.size() - in_pairs};
  }

  void uniteAt(std::span<const EdgeUse> uses) {
    for (const EdgeUse& use : uses) sheets_.unite(pair_of_[uses[0].half_edge / 3], pair_of_[use.half_edge / 3]);
  }

  const TriangleMesh& mesh_;
  std::vector<TwinGroup> pairs_;
  std::vector<Index> pair_of_;
  DisjointSets sheets_;
};

}  // namespace

std::vector<TwinGroup> twinGroups(const TriangleMesh& mesh) {
  std::vector<TwinGroup> groups;
  const IndexRows rows = trianglesByLowestVertex(mesh);
  std::vector<std::pair<Triangle, Index>> row;
  for (Index v = 0; v < rows.rows(); ++v) {
    if (rows[v].size() < 2) continue;
    row.clear();
    for (Index t : rows[v]) {
      if (hasThreeVertices(mesh.triangles[t])) row.emplace_back(sorted(mesh.triangles[t]), t);
    }
    std::sort(row.begin(), row.end());
    for (std::size_t i = 1; i < row.size(); ++i) {
      if (row[i].first != row[i - 1].first) continue;
      const bool goes_on = !groups.empty() && groups.back().back() == row[i - 1].second;
      if (!goes_on) groups.push_back({row[i - 1].second});
      groups.back().push_back(row[i].second);
    }
  }
  return groups;
}

DoubledRemoved removeDoubled(TriangleMesh& mesh) {
  const std::size_t duplicates = removeDuplicates(mesh);
  auto pairs = twinGroups(mesh);
  DoubledRemoved removed;
  if (!pairs.empty()) {
    std::vector<bool> marked(mesh.triangles.size(), false);
    removed = OppositePairs(mesh, std::move(pairs)).choose(marked);
    removeMarked(mesh, marked);
  }
  removed.duplicates = duplicates;
  return removed;
}

}  // namespace palpate::mesh
