// Triangles over the same vertices are found by sorting within the row of their lowest vertex and cancel each other,
// one way against the other; connected opposite pairs that are left are one sheet, whose fate depends on how its rim
// meets the rest of the surface.
//
// A mesh whose every edge is used as often one way as the other is a cycle of simplicial homology, and removing a
// triangle together with its opposite leaves it one.
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

/// The triangles over three vertices, counted with their sign.
struct TwinCount {
  std::array<std::vector<Index>, 2> wound;  // [1] runs up
  /// Surplus of one winding over the other.
  std::size_t surplus() const {
    return std::max(wound[0].size(), wound[1].size()) - std::min(wound[0].size(), wound[1].size());
  }
  /// Winding with more triangles, an index into `wound`.
  std::size_t larger() const { return wound[1].size() > wound[0].size() ? 1 : 0; }
};

TwinCount countTwins(const TriangleMesh& mesh, const TwinGroup& group) {
  TwinCount count;
  for (const Index t : group) count.wound[isAscending(mesh.triangles[t]) ? 1 : 0].push_back(t);
  return count;
}

/// Several equal triangles that nothing cancels: wound more than once, or where bodies share a part of their skin.
/// Those that hang together across edges are cut down to one each, or stay, whichever leaves fewer edges unbalanced.
class Multiples {
 public:
  /// `multiples`: each two triangles or more, with the same winding. Marked triangles are gone already.
  Multiples(const TriangleMesh& mesh, const std::vector<TwinGroup>& multiples, const std::vector<bool>& marked)
      : multiples_(multiples), multiple_of_(mesh.triangles.size(), kNoIndex), clusters_(multiples.size()) {
    for (Index m = 0; m < multiples.size(); ++m) {
      for (const Index t : multiples[m]) multiple_of_[t] = m;
    }
    const EdgeUses edges = edgeUses(mesh);
    forEachEdge(edges, [&](Index, Index, std::span<const EdgeUse> uses) { uniteAt(uses); });
    worse_by_.assign(multiples.size(), 0);
    forEachEdge(edges, [&](Index low, Index, std::span<const EdgeUse> uses) { weigh(mesh, low, uses, marked); });
  }

  /// Marks what goes; returns how many.
  std::size_t markSurplus(std::vector<bool>& marked) {
    std::size_t count = 0;
    for (Index m = 0; m < multiples_.size(); ++m) {
      if (worse_by_[clusters_.root(m)] > 0) continue;
      for (std::size_t i = 1; i < multiples_[m].size(); ++i) marked[multiples_[m][i]] = true;
      count += multiples_[m].size() - 1;
    }
    return count;
  }

 private:
  Index multipleAt(const EdgeUse& use) const { return multiple_of_[use.half_edge / 3]; }

  void uniteAt(std::span<const EdgeUse> uses) {
    Index first = kNoIndex;
    for (const EdgeUse& use : uses) {
      if (multipleAt(use) == kNoIndex) continue;
      if (first == kNoIndex) first = multipleAt(use);
      clusters_.unite(first, multipleAt(use));
    }
  }

  /// Adds to the cluster at an edge, if there is one, how much the edge's balance suffers from cutting it down.
  void weigh(const TriangleMesh& mesh, Index low, std::span<const EdgeUse> uses, const std::vector<bool>& marked) {
    Index cluster = kNoIndex;
    int whole = 0;
    int cut_down = 0;
    for (const EdgeUse& use : uses) {
      const Index t = use.half_edge / 3;
      if (marked[t]) continue;
      const int direction = halfEdgeStart(mesh, use.half_edge) == low ? 1 : -1;
      whole += direction;
      if (multiple_of_[t] != kNoIndex) cluster = clusters_.root(multiple_of_[t]);
      if (multiple_of_[t] == kNoIndex || multiples_[multiple_of_[t]].front() == t) cut_down += direction;
    }
    if (cluster != kNoIndex) worse_by_[cluster] += (cut_down != 0 ? 1 : 0) - (whole != 0 ? 1 : 0);
  }

  const std::vector<TwinGroup>& multiples_;
  std::vector<Index> multiple_of_;
  DisjointSets clusters_;
  std::vector<int> worse_by_;  // per cluster (its root): edges that only stay balanced uncut, less those the other way
};

/// Leaves each group its surplus, or one opposite pair when there is none.
void cancelTwins(TriangleMesh& mesh, const std::vector<TwinGroup>& groups, DoubledRemoved& removed) {
  std::vector<bool> marked(mesh.triangles.size(), false);
  std::vector<TwinGroup> multiples;
  for (const TwinGroup& group : groups) {
    const TwinCount count = countTwins(mesh, group);
    const std::size_t surplus = count.surplus();
    if (surplus == 0) {
      for (const auto& wound : count.wound) {
        for (std::size_t i = 1; i < wound.size(); ++i) marked[wound[i]] = true;
        removed.duplicates += wound.size() - 1;
      }
      continue;
    }
    const auto& more = count.wound[count.larger()];
    const auto& fewer = count.wound[1 - count.larger()];
    for (const Index t : fewer) marked[t] = true;
    for (std::size_t i = surplus; i < more.size(); ++i) marked[more[i]] = true;
    removed.cancelled += fewer.size();
    if (surplus > 1) multiples.emplace_back(more.begin(), more.begin() + static_cast<std::ptrdiff_t>(surplus));
  }
  if (!multiples.empty()) removed.duplicates += Multiples(mesh, multiples, marked).markSurplus(marked);
  removeMarked(mesh, marked);
}

std::vector<TwinGroup> oppositePairs(const TriangleMesh& mesh) {
  std::vector<TwinGroup> pairs = twinGroups(mesh);
  std::erase_if(pairs, [&](const TwinGroup& group) { return countTwins(mesh, group).surplus() > 0; });
  return pairs;
}

/// Contact of a connected sheet of opposite pairs with the rest of the surface.
struct Rim {
  bool has_free_edge = false;  ///< an edge of one pair and of nothing else
  bool on_surface = false;     ///< an edge where the rest is complete without the sheet
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
  void choose(std::vector<bool>& marked, DoubledRemoved& removed) {
    const bool all_doubled = 2 * pairs_.size() == mesh_.triangles.size();
    const std::vector<Rim> rims = rimsOfSheets();
    for (Index p = 0; p < pairs_.size(); ++p) {
      const Rim& rim = rims[sheets_.root(p)];
      const bool is_needed = all_doubled || (rim.fills_hole && !rim.on_surface && !rim.has_free_edge);
      marked[pairs_[p][0]] = !is_needed;
      marked[pairs_[p][1]] = true;
      ++(is_needed ? removed.sides : removed.opposite_pairs);
    }
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
      if (!hasRepeatedCorner(mesh.triangles[t])) row.emplace_back(sorted(mesh.triangles[t]), t);
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
  DoubledRemoved removed;
  const std::vector<TwinGroup> groups = twinGroups(mesh);
  if (groups.empty()) return removed;
  cancelTwins(mesh, groups, removed);
  auto pairs = oppositePairs(mesh);
  if (pairs.empty()) return removed;
  std::vector<bool> marked(mesh.triangles.size(), false);
  OppositePairs(mesh, std::move(pairs)).choose(marked, removed);
  removeMarked(mesh, marked);
  return removed;
}

}  // namespace palpate::mesh
