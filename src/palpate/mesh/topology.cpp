#include "palpate/mesh/topology.h"

#include <algorithm>

namespace palpate::mesh {

namespace {

struct DirectedEdge {
  std::uint64_t key;  // (lower vertex << 32) | higher vertex
  Index triangle;
  std::uint8_t edge;
  bool ascending;
};

std::vector<DirectedEdge> sortedEdges(const TriangleMesh& mesh) {
  std::vector<DirectedEdge> edges;
  edges.reserve(mesh.triangles.size() * 3);
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    for (std::uint8_t e = 0; e < 3; ++e) {
      const Index a = mesh.triangles[t][e];
      const Index b = mesh.triangles[t][(e + 1) % 3];
      const auto [low, high] = std::minmax(a, b);
      edges.push_back({(std::uint64_t{low} << 32) | high, t, e, a < b});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const DirectedEdge& l, const DirectedEdge& r) {
    return l.key != r.key ? l.key < r.key : l.triangle < r.triangle;
  });
  return edges;
}

}  // namespace

IndexRows trianglesOfVertices(const TriangleMesh& mesh) {
  IndexRows rows;
  rows.offsets.assign(mesh.positions.size() + 1, 0);
  for (const Triangle& triangle : mesh.triangles) {
    for (Index v : triangle) ++rows.offsets[v + 1];
  }
  for (std::size_t v = 1; v < rows.offsets.size(); ++v) rows.offsets[v] += rows.offsets[v - 1];
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

std::vector<std::array<Index, 3>> neighboursOfTriangles(const TriangleMesh& mesh) {
  std::vector<std::array<Index, 3>> neighbours(mesh.triangles.size(), {kNoIndex, kNoIndex, kNoIndex});
  const auto edges = sortedEdges(mesh);
  for (std::size_t first = 0; first < edges.size();) {
    std::size_t last = first + 1;
    while (last < edges.size() && edges[last].key == edges[first].key) ++last;
    if (last - first == 2 && edges[first].ascending != edges[first + 1].ascending) {
      neighbours[edges[first].triangle][edges[first].edge] = edges[first + 1].triangle;
      neighbours[edges[first + 1].triangle][edges[first + 1].edge] = edges[first].triangle;
    }
    first = last;
  }
  return neighbours;
}

}  // namespace palpate::mesh
