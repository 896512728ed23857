// Passes of two steps until no sliver is left: needles (a short edge) collapse, caps (a corner on the long edge) are
// sewn to the neighbour across.
//
// Needles and caps as in Botsch and Kobbelt, "A robust procedure to eliminate degenerate faces from triangle
// meshes" (2001), which cuts the mesh by planes where this splits one neighbour.
#include "palpate/mesh/slivers.h"

#include <algorithm>
#include <utility>

#include "palpate/mesh/components.h"
#include "palpate/mesh/topology.h"

namespace palpate::mesh {

namespace {

/// Each pass removes all slivers that do not touch each other. Real meshes need one to three.
constexpr int kMaxPasses = 16;
/// Sewing splits neighbours; a book of many pages with many slivers in its spine could grow without end.
constexpr std::size_t kMaxGrowth = 2;

double edgeLength(const TriangleMesh& mesh, const Triangle& t, std::size_t edge) {
  return (mesh.positions[t[(edge + 1) % 3]] - mesh.positions[t[edge]]).norm();
}

std::size_t longestEdge(const TriangleMesh& mesh, const Triangle& t) {
  std::size_t longest = 0;
  for (std::size_t edge : {1u, 2u}) {
    if (edgeLength(mesh, t, edge) > edgeLength(mesh, t, longest)) longest = edge;
  }
  return longest;
}

/// `first` stays at the same triangle.
std::size_t dropRepeatedCorners(TriangleMesh& mesh, Index& first) {
  const auto middle = mesh.triangles.begin() + static_cast<std::ptrdiff_t>(first);
  const auto dropped_before = std::count_if(mesh.triangles.begin(), middle, hasRepeatedCorner);
  first -= static_cast<Index>(dropped_before);
  return std::erase_if(mesh.triangles, hasRepeatedCorner);
}

/// Slivers from `first` on with an edge shorter than `height`: the ends of that edge become the lower one of them.
std::size_t collapseShortEdges(TriangleMesh& mesh, double height, Index& first) {
  DisjointSets merged(mesh.positions.size());
  bool any = false;
  for (Index i = first; i < mesh.triangles.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    if (!isSliver(mesh, t, height)) continue;
    for (std::size_t edge = 0; edge < 3; ++edge) {
      if (edgeLength(mesh, t, edge) <= height) any |= merged.unite(t[edge], t[(edge + 1) % 3]);
    }
  }
  if (any) {
    for (Triangle& t : mesh.triangles) {
      for (Index& v : t) v = merged.root(v);
    }
  }
  return dropRepeatedCorners(mesh, first);
}

/// Removes flat slivers: each other triangle at the long edge is split at the sliver's third corner, which is on it.
class Sewing {
 public:
  Sewing(TriangleMesh& mesh, double height, std::size_t most_triangles)
      : mesh_(mesh), height_(height), most_triangles_(most_triangles), edges_(edgeUses(mesh)) {
    touched_.assign(mesh.triangles.size(), false);
  }

  /// Those from `first` on.
  std::size_t run(Index& first) {
    std::size_t sewn = 0;
    const std::size_t count = mesh_.triangles.size();
    for (Index t = first; t < count && mesh_.triangles.size() < most_triangles_; ++t) {
      if (!touched_[t] && isSliver(mesh_, mesh_.triangles[t], height_) && sew(t)) ++sewn;
    }
    dropRepeatedCorners(mesh_, first);
    return sewn;
  }

 private:
  std::span<const EdgeUse> findUses(Index a, Index b) const {
    const auto [low, high] = std::minmax(a, b);
    const auto row_begin = edges_.uses.begin() + edges_.offsets[low];
    const auto row_end = edges_.uses.begin() + edges_.offsets[low + 1];
    const auto begin = std::partition_point(row_begin, row_end, [h = high](const EdgeUse& u) { return u.high < h; });
    const auto end = std::partition_point(begin, row_end, [h = high](const EdgeUse& u) { return u.high <= h; });
    return {edges_.uses.data() + (begin - edges_.uses.begin()), static_cast<std::size_t>(end - begin)};
  }

  /// False when a neighbour was changed in this pass already: its edges no longer match edges_.
  bool sew(Index sliver) {
    const Triangle t = mesh_.triangles[sliver];
    const std::size_t edge = longestEdge(mesh_, t);
    const Index third = t[(edge + 2) % 3];
    const auto uses = findUses(t[edge], t[(edge + 1) % 3]);
    if (std::any_of(uses.begin(), uses.end(), [&](const EdgeUse& u) { return touched_[u.half_edge / 3]; }))
      return false;
    for (const EdgeUse& use : uses) {
      if (use.half_edge / 3 != sliver) splitAt(use.half_edge, third);
    }
    erase(sliver);
    return true;
  }

  /// (a, b, c) becomes (a, m, c) and (m, b, c), where the half-edge is a-b. With m = c nothing is left of it.
  void splitAt(Index half_edge, Index middle) {
    const Index t = half_edge / 3;
    const Triangle old = mesh_.triangles[t];
    const std::size_t edge = half_edge % 3;
    const auto [a, b, c] = std::tuple(old[edge], old[(edge + 1) % 3], old[(edge + 2) % 3]);
    touched_[t] = true;
    mesh_.triangles[t] = {a, middle, c};
    mesh_.triangles.push_back({middle, b, c});
  }

  /// Marked by a repeated corner; removed at the end of the pass, so that indices stay valid.
  void erase(Index t) {
    touched_[t] = true;
    mesh_.triangles[t] = {0, 0, 0};
  }

  TriangleMesh& mesh_;
  double height_;
  std::size_t most_triangles_;
  EdgeUses edges_;
  std::vector<bool> touched_;
};

bool anySliver(const TriangleMesh& mesh, double height, Index first) {
  return std::any_of(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(first), mesh.triangles.end(),
                     [&](const Triangle& t) { return isSliver(mesh, t, height); });
}

void collapseAndSew(TriangleMesh& mesh, double height, Index first, SliversRemoved& removed) {
  const std::size_t most_triangles = mesh.triangles.size() * kMaxGrowth + 1000;
  for (int pass = 0; pass < kMaxPasses && anySliver(mesh, height, first); ++pass) {
    removed.collapsed += collapseShortEdges(mesh, height, first);
    removed.sewn += Sewing(mesh, height, most_triangles).run(first);
  }
}

}  // namespace

double sliverHeight(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Triangle& triangle : mesh.triangles) {
    for (Index v : triangle) box.extend(mesh.positions[v]);
  }
  return box.isEmpty() ? 0.0 : kSliverShare * box.diagonal().norm();
}

bool isSliver(const TriangleMesh& mesh, const Triangle& t, double height) {
  if (hasRepeatedCorner(t)) return true;
  const double area2 = areaVector2(mesh, t).norm();
  const double longest = std::max({edgeLength(mesh, t, 0), edgeLength(mesh, t, 1), edgeLength(mesh, t, 2)});
  return !(area2 > height * longest);
}

SliversRemoved removeSlivers(TriangleMesh& mesh) {
  SliversRemoved removed;
  const double height = sliverHeight(mesh);
  collapseAndSew(mesh, height, 0, removed);
  removed.dropped = std::erase_if(mesh.triangles, [&](const Triangle& t) { return isSliver(mesh, t, height); });
  return removed;
}

void sewCracks(TriangleMesh& mesh, Index first, double height) {
  SliversRemoved removed;
  collapseAndSew(mesh, height, first, removed);
}

}  // namespace palpate::mesh
