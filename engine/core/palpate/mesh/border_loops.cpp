// From each border half-edge a walk around the fan of triangles at its start leads to the next one; runs of them are
// cut into loops wherever they return to a vertex.
#include "palpate/mesh/border_loops.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <tuple>
#include <utility>

#include "palpate/base/elementary.h"

namespace palpate::mesh {

namespace {

/// Gaps up to this (radian) the wrong way count as zero: the sides of a crack overlap a little.
constexpr double kOverlapAngle = 0.3;
/// More fans in one vertex are a fault of another kind.
constexpr std::size_t kMaxFans = 16;

/// Border half-edges, which run against the border: the border arrives where one starts and leaves from where one ends.
struct BorderVertex {
  std::vector<Index> arriving;
  std::vector<Index> leaving;
};

/// The border half-edge after each one.
class Pairing {
 public:
  Pairing(const TriangleMesh& mesh, const EdgeUses& edges) : mesh_(mesh) {
    std::vector<bool> is_ambiguous(mesh.positions.size(), false);
    forEachEdge(edges, [&](Index low, Index high, std::span<const EdgeUse> uses) {
      if (uses.size() == 1) {
        border_.push_back(uses[0].half_edge);
      } else if (uses.size() > 2 || halfEdgeStart(mesh, uses[0].half_edge) == halfEdgeStart(mesh, uses[1].half_edge)) {
        is_ambiguous[low] = is_ambiguous[high] = true;
      }
    });
    std::sort(border_.begin(), border_.end());
    for (const Index h : border_) {
      vertices_[halfEdgeStart(mesh, h)].arriving.push_back(h);
      vertices_[halfEdgeEnd(mesh, h)].leaving.push_back(h);
    }
    for (const auto& [vertex, at] : vertices_) {
      if (!is_ambiguous[vertex] && at.arriving.size() == at.leaving.size()) pair(vertex, at);
    }
  }

  /// Ascending.
  const std::vector<Index>& border() const { return border_; }

  /// kNoIndex: not clear.
  Index after(Index half_edge) const {
    const auto found = next_.find(half_edge);
    return found == next_.end() ? kNoIndex : found->second;
  }

 private:
  void pair(Index vertex, const BorderVertex& at) {
    if (at.arriving.size() == 1) {
      next_[at.arriving[0]] = at.leaving[0];
    } else if (at.arriving.size() <= kMaxFans) {
      pairAcrossGaps(vertex, at);
    }
  }

  void pairAcrossGaps(Index vertex, const BorderVertex& at) {
    const Vec3 normal = normalAt(at);
    std::vector<std::tuple<double, Index, Index>> gaps;
    for (const Index in : at.arriving) {
      for (const Index out : at.leaving) {
        gaps.emplace_back(gapBetween(vertex, halfEdgeStart(mesh_, out), halfEdgeEnd(mesh_, in), normal), in, out);
      }
    }
    std::sort(gaps.begin(), gaps.end());
    std::vector<Index> taken;
    for (const auto& [angle, in, out] : gaps) {
      if (next_.contains(in) || std::count(taken.begin(), taken.end(), out) > 0) continue;
      next_[in] = out;
      taken.push_back(out);
    }
  }

  /// Averages the two triangles at the border here; those between them hardly change it.
  Vec3 normalAt(const BorderVertex& at) const {
    Vec3 sum = Vec3::Zero();
    for (const auto& side : {at.arriving, at.leaving}) {
      for (const Index h : side) sum += areaVector2(mesh_, mesh_.triangles[h / 3]);
    }
    return sum.stableNormalized();
  }

  /// Turn around the normal from the edge that leaves to the one that arrived: the sector between them is empty.
  double gapBetween(Index vertex, Index to, Index from, const Vec3& normal) const {
    const Vec3 u = mesh_.positions[to] - mesh_.positions[vertex];
    const Vec3 w = mesh_.positions[from] - mesh_.positions[vertex];
    const double angle = elementary::atan2(normal.dot(u.cross(w)), u.dot(w) - normal.dot(u) * normal.dot(w));
    return angle < -kOverlapAngle ? angle + 2.0 * std::numbers::pi : std::abs(angle);
  }

  const TriangleMesh& mesh_;
  std::vector<Index> border_;
  std::map<Index, BorderVertex> vertices_;
  std::map<Index, Index> next_;
};

/// Cuts closed runs into loops.
class LoopCutter {
 public:
  LoopCutter(const TriangleMesh& mesh, Borders& borders) : mesh_(mesh), borders_(borders) {
    place_in_run_.assign(mesh.positions.size(), kNoIndex);
  }

  void cut(const std::vector<Index>& run) {
    for (const Index h : run) {
      const Index vertex = halfEdgeEnd(mesh_, h);
      if (place_in_run_[vertex] != kNoIndex) cutLoop(place_in_run_[vertex]);
      place_in_run_[vertex] = static_cast<Index>(path_.size());
      path_.push_back(h);
    }
    cutLoop(0);
  }

 private:
  void cutLoop(Index begin) {
    BorderLoop loop;
    for (Index i = begin; i < path_.size(); ++i) {
      loop.half_edges.push_back(path_[i]);
      loop.vertices.push_back(halfEdgeEnd(mesh_, path_[i]));
      place_in_run_[loop.vertices.back()] = kNoIndex;
    }
    path_.resize(begin);
    borders_.loops.push_back(std::move(loop));
  }

  const TriangleMesh& mesh_;
  Borders& borders_;
  std::vector<Index> path_;          // half-edges of the run that are in no loop yet
  std::vector<Index> place_in_run_;  // place of each vertex in path_
};

}  // namespace

Borders findBorders(const TriangleMesh& mesh, const EdgeUses& edges) {
  Borders borders;
  const Pairing pairing(mesh, edges);
  borders.edges = pairing.border().size();
  if (borders.edges == 0) return borders;
  LoopCutter cutter(mesh, borders);
  std::set<Index> done;
  std::vector<Index> run;
  for (const Index first : pairing.border()) {
    run.clear();
    Index next = first;
    for (; next != kNoIndex && done.insert(next).second; next = pairing.after(next)) run.push_back(next);
    if (next == first && !run.empty()) {
      cutter.cut(run);
    } else {
      borders.unclosed.insert(borders.unclosed.end(), run.begin(), run.end());
    }
  }
  return borders;
}

double leastArea(const TriangleMesh& mesh, const BorderLoop& loop) {
  const Vec3& origin = mesh.positions[loop.vertices[0]];
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 2; i < loop.vertices.size(); ++i) {
    sum += areaVector2(origin, mesh.positions[loop.vertices[i - 1]], mesh.positions[loop.vertices[i]]);
  }
  return 0.5 * sum.norm();
}

double fanArea(const TriangleMesh& mesh, const BorderLoop& loop) {
  Vec3 middle = Vec3::Zero();
  for (const Index v : loop.vertices) middle += mesh.positions[v] / static_cast<double>(loop.vertices.size());
  double area = 0.0;
  for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
    const Index next = loop.vertices[(i + 1) % loop.vertices.size()];
    area += 0.5 * areaVector2(middle, mesh.positions[loop.vertices[i]], mesh.positions[next]).norm();
  }
  return area;
}

double lengthOf(const TriangleMesh& mesh, const BorderLoop& loop) {
  double length = 0.0;
  for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
    const Index next = loop.vertices[(i + 1) % loop.vertices.size()];
    length += (mesh.positions[next] - mesh.positions[loop.vertices[i]]).norm();
  }
  return length;
}

}  // namespace palpate::mesh
