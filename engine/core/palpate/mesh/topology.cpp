// Rows are counted, summed up and filled: two passes over the triangles, no search.
//
// Based on: compressed sparse rows; half-edges named by triangle and side as the "directed edges" of Campagna, Kobbelt
// and Seidel (1998), grouped by a sort instead of stored with their mates.
#include "palpate/mesh/topology.h"

#include <algorithm>
#include <utility>

#include "palpate/base/background.h"

namespace palpate::mesh {

namespace {

/// The edges of fewer are sorted in less time than starting a thread is worth.
constexpr std::size_t kSharedVertices = 50'000;

/// Turns counts in offsets[row + 1] into offsets.
void sumUp(std::vector<Index>& offsets) {
  for (std::size_t row = 1; row < offsets.size(); ++row) offsets[row] += offsets[row - 1];
}

}  // namespace

IndexRows trianglesOfVertices(const TriangleMesh& mesh) {
  IndexRows rows;
  rows.offsets.assign(mesh.positions.size() + 1, 0);
  for (const Triangle& triangle : mesh.triangles) {
    for (Index v : triangle) ++rows.offsets[v + 1];
  }
  sumUp(rows.offsets);
  rows.entries.resize(mesh.triangles.size() * 3);
  std::vector<Index> next(rows.offsets.begin(), rows.offsets.end() - 1);
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    for (Index v : mesh.triangles[t]) rows.entries[next[v]++] = t;
  }
  return rows;
}

IndexRows neighboursOfVertices(const TriangleMesh& mesh, const IndexRows& triangles_of_vertices) {
  IndexRows rows;
  rows.offsets.reserve(mesh.positions.size() + 1);
  rows.offsets.push_back(0);
  // Around a fan there are as many as triangles, at a border one more; grown on the way it would be there twice.
  rows.entries.reserve(triangles_of_vertices.entries.size() + mesh.positions.size());
  std::vector<Index> ring;
  for (Index v = 0; v < mesh.positions.size(); ++v) {
    ring.clear();
    for (Index t : triangles_of_vertices[v]) {
      for (Index other : mesh.triangles[t]) {
        if (other != v) ring.push_back(other);
      }
    }
    std::sort(ring.begin(), ring.end());
    rows.entries.insert(rows.entries.end(), ring.begin(), std::unique(ring.begin(), ring.end()));
    rows.offsets.push_back(static_cast<Index>(rows.entries.size()));
  }
  return rows;
}

EdgeUses edgeUses(const TriangleMesh& mesh) {
  EdgeUses edges;
  edges.offsets.assign(mesh.positions.size() + 1, 0);
  const auto half_edges = static_cast<Index>(mesh.triangles.size() * 3);
  const auto for_each_edge = [&](const auto& visit) {
    for (Index h = 0; h < half_edges; ++h) {
      const auto [low, high] = std::minmax({halfEdgeStart(mesh, h), halfEdgeEnd(mesh, h)});
      if (low != high) visit(low, high, h);
    }
  };
  for_each_edge([&](Index low, Index, Index) { ++edges.offsets[low + 1]; });
  sumUp(edges.offsets);
  edges.uses.resize(edges.offsets.back());
  std::vector<Index> next(edges.offsets.begin(), edges.offsets.end() - 1);
  for_each_edge([&](Index low, Index high, Index h) { edges.uses[next[low]++] = {high, h}; });
  shareOut(mesh.positions.size(), kSharedVertices, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      std::sort(edges.uses.begin() + edges.offsets[v], edges.uses.begin() + edges.offsets[v + 1],
                [](const EdgeUse& l, const EdgeUse& r) {
                  return l.high != r.high ? l.high < r.high : l.half_edge < r.half_edge;
                });
    }
  });
  return edges;
}

std::vector<std::array<Index, 3>> neighboursOfTriangles(const TriangleMesh& mesh) {
  std::vector<std::array<Index, 3>> neighbours(mesh.triangles.size(), {kNoIndex, kNoIndex, kNoIndex});
  forEachEdge(edgeUses(mesh), [&](Index, Index, std::span<const EdgeUse> uses) {
    if (uses.size() != 2) return;
    const auto [first, second] = std::pair(uses[0].half_edge, uses[1].half_edge);
    if (halfEdgeStart(mesh, first) == halfEdgeStart(mesh, second)) return;
    neighbours[first / 3][first % 3] = second / 3;
    neighbours[second / 3][second % 3] = first / 3;
  });
  return neighbours;
}

}  // namespace palpate::mesh
