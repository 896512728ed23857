// Each vertex of the loop is looked for on all its edges; then every piece of an edge must have its opposite.
//
// As the zipping of Turk and Levoy, "Zippered polygon meshes from range images", 1994, for borders that coincide.
#include "palpate/mesh/cracks.h"

#include <algorithm>
#include <array>
#include <set>
#include <span>
#include <utility>

#include "palpate/mesh/holes.h"

namespace palpate::mesh {

namespace {

/// Mesh programs leave no cracks of more edges (2,000: 4 million distances, 20 ms).
constexpr std::size_t kMaxCrackEdges = 2000;

/// Position of the point along the way from `from` to `to` (0..1), when it is near the inside of that way.
std::optional<double> placeOn(const Vec3& from, const Vec3& to, const Vec3& point, double width) {
  const Vec3 way = to - from;
  const double length = way.norm();
  const double along = (point - from).dot(way) / length;
  if (!(along > width && along < length - width)) return std::nullopt;
  if ((from + along / length * way - point).squaredNorm() > width * width) return std::nullopt;
  return along / length;
}

/// Every piece of the loop's edges is run along once each way.
bool allMatched(const std::vector<std::pair<Index, Index>>& pieces) {
  std::set<std::pair<Index, Index>> unmatched;
  for (const auto& [from, to] : pieces) {
    if (unmatched.erase({to, from}) == 0 && !unmatched.emplace(from, to).second) return false;
  }
  return unmatched.empty();
}

/// The pieces of one triangle, whose ring of corners has more vertices on its sides.
std::vector<Triangle> makePieces(const TriangleMesh& mesh, const Triangle& t, std::span<const SideSplit> splits) {
  std::vector<Index> ring;
  std::vector<std::array<bool, 3>> on_side;
  for (std::size_t side = 0; side < 3; ++side) {
    ring.push_back(t[side]);
    on_side.push_back({side != 2, side != 0, side != 1});  // a corner is on its own side and on the one before
    const auto split =
        std::find_if(splits.begin(), splits.end(), [&](const SideSplit& s) { return s.half_edge % 3 == side; });
    if (split == splits.end()) continue;
    for (const Index v : split->vertices) {
      ring.push_back(v);
      on_side.push_back({side == 0, side == 1, side == 2});
    }
  }
  std::vector<Vec3> places;
  for (const Index v : ring) places.push_back(mesh.positions[v]);
  const auto filling = triangulateLoop(places, [&](Index i, Index j) {
    for (std::size_t side = 0; side < 3; ++side) {
      if (on_side[i][side] && on_side[j][side]) return false;
    }
    return true;
  });
  std::vector<Triangle> pieces;
  for (const auto& [a, b, c] : filling->triangles) pieces.push_back({ring[a], ring[b], ring[c]});
  return pieces;
}

/// The same for vertices on a single side, which leave only one way to cut.
std::vector<Triangle> makeFan(const Triangle& t, const SideSplit& split) {
  const std::size_t side = split.half_edge % 3;
  const Index tip = t[(side + 2) % 3];
  std::vector<Triangle> pieces;
  Index last = t[side];
  for (const Index v : split.vertices) {
    pieces.push_back({last, v, tip});
    last = v;
  }
  pieces.push_back({last, t[(side + 1) % 3], tip});
  return pieces;
}

}  // namespace

std::optional<std::vector<SideSplit>> planCrack(const TriangleMesh& mesh, const BorderLoop& loop, double width) {
  if (loop.vertices.size() > kMaxCrackEdges) return std::nullopt;
  std::vector<SideSplit> splits;
  std::vector<std::pair<Index, Index>> pieces;
  std::vector<std::pair<double, Index>> on_edge;
  for (const Index h : loop.half_edges) {
    const Index from = halfEdgeStart(mesh, h);
    const Index to = halfEdgeEnd(mesh, h);
    on_edge.clear();
    for (const Index v : loop.vertices) {
      if (v == from || v == to) continue;
      const auto place = placeOn(mesh.positions[from], mesh.positions[to], mesh.positions[v], width);
      if (place) on_edge.emplace_back(*place, v);
    }
    std::sort(on_edge.begin(), on_edge.end());
    Index last = from;
    SideSplit split{h, {}};
    for (const auto& [place, v] : on_edge) {
      pieces.emplace_back(last, v);
      split.vertices.push_back(v);
      last = v;
    }
    pieces.emplace_back(last, to);
    if (!split.vertices.empty()) splits.push_back(std::move(split));
  }
  if (!allMatched(pieces)) return std::nullopt;
  return splits;
}

void splitSides(TriangleMesh& mesh, std::vector<SideSplit> splits) {
  std::sort(splits.begin(), splits.end(),
            [](const SideSplit& l, const SideSplit& r) { return l.half_edge < r.half_edge; });
  for (std::size_t first = 0; first < splits.size();) {
    const Index t = splits[first].half_edge / 3;
    std::size_t end = first;
    while (end < splits.size() && splits[end].half_edge / 3 == t) ++end;
    const Triangle whole = mesh.triangles[t];
    const auto pieces = end == first + 1
                            ? makeFan(whole, splits[first])
                            : makePieces(mesh, whole, std::span<const SideSplit>(&splits[first], end - first));
    mesh.triangles[t] = pieces[0];
    mesh.triangles.insert(mesh.triangles.end(), pieces.begin() + 1, pieces.end());
    first = end;
  }
}

}  // namespace palpate::mesh
