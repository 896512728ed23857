// From each border half-edge a walk around the fan of triangles at its start leads to the next one; runs of them are
// cut into loops wherever they come back to a vertex. Own.
#include "palpate/mesh/border_loops.h"

#include <algorithm>
#include <utility>

namespace palpate::mesh {

namespace {

constexpr Index kBorder = kNoIndex;           // no triangle across
constexpr Index kNotOrdinary = kNoIndex - 1;  // several, or one that runs the same way

Index previousInTriangle(Index half_edge) { return half_edge % 3 == 0 ? half_edge + 2 : half_edge - 1; }

/// What is across each half-edge: the other half-edge, kBorder or kNotOrdinary.
std::vector<Index> oppositeHalfEdges(const TriangleMesh& mesh, const EdgeUses& edges, std::size_t& border_edges) {
  std::vector<Index> across(mesh.triangles.size() * 3, kNotOrdinary);
  forEachEdge(edges, [&](Index, Index, std::span<const EdgeUse> uses) {
    const Index first = uses[0].half_edge;
    if (uses.size() == 1) {
      across[first] = kBorder;
      ++border_edges;
    } else if (uses.size() == 2 && halfEdgeStart(mesh, first) != halfEdgeStart(mesh, uses[1].half_edge)) {
      across[first] = uses[1].half_edge;
      across[uses[1].half_edge] = first;
    }
  });
  return across;
}

/// The border half-edge that ends where this one starts, in the same fan; kNotOrdinary where the fan has no such end.
Index nextAtBorder(const std::vector<Index>& across, Index half_edge) {
  Index next = previousInTriangle(half_edge);
  while (across[next] < kNotOrdinary) next = previousInTriangle(across[next]);
  return across[next] == kBorder ? next : kNotOrdinary;
}

/// Cuts closed runs into loops.
class LoopCutter {
 public:
  LoopCutter(const TriangleMesh& mesh, Borders& borders) : mesh_(mesh), borders_(borders) {
    place_in_run_.assign(mesh.positions.size(), kNoIndex);
  }

  void cut(const std::vector<Index>& run) {
    for (const Index h : run) {
      const Index vertex = halfEdgeEnd(mesh_, h);
      if (place_in_run_[vertex] != kNoIndex) takeLoop(place_in_run_[vertex]);
      place_in_run_[vertex] = static_cast<Index>(path_.size());
      path_.push_back(h);
    }
    takeLoop(0);
  }

 private:
  void takeLoop(Index begin) {
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
  std::vector<Index> place_in_run_;  // of each vertex, in path_
};

}  // namespace

Borders findBorders(const TriangleMesh& mesh, const EdgeUses& edges) {
  Borders borders;
  const std::vector<Index> across = oppositeHalfEdges(mesh, edges, borders.edges);
  if (borders.edges == 0) return borders;
  LoopCutter cutter(mesh, borders);
  std::vector<bool> done(across.size(), false);
  std::vector<Index> run;
  for (Index h = 0; h < across.size(); ++h) {
    if (across[h] != kBorder || done[h]) continue;
    run.clear();
    Index next = h;
    for (; next != kNotOrdinary && !done[next]; next = nextAtBorder(across, next)) {
      done[next] = true;
      run.push_back(next);
    }
    if (next == h) {
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
