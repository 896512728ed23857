#include "palpate/mesh/topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "palpate/mesh/triangle_mesh.h"
#include "support/mesh_zoo.h"

namespace palpate::mesh {

// A square of two triangles: 0-1-2 and 0-2-3.
TriangleMesh square() { return {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}}; }

/// The zoo without the specimen whose indices topology must not be asked about.
std::vector<zoo::Specimen> sound() {
  auto all = zoo::specimens();
  std::erase_if(all, [](const zoo::Specimen& s) { return s.name == "cube with wrong indices"; });
  return all;
}

TEST(Topology, SquareKnowsItsNeighbours) {
  const auto mesh = square();
  const auto neighbours = neighboursOfTriangles(mesh);
  EXPECT_EQ(neighbours[0], (std::array<Index, 3>{kNoIndex, kNoIndex, 1}));
  EXPECT_EQ(neighbours[1], (std::array<Index, 3>{0, kNoIndex, kNoIndex}));
  const auto of_vertices = trianglesOfVertices(mesh);
  EXPECT_EQ(of_vertices[0].size(), 2u);
  const auto rings = neighboursOfVertices(mesh, of_vertices);
  EXPECT_EQ(std::vector<Index>(rings[0].begin(), rings[0].end()), (std::vector<Index>{1, 2, 3}));
  EXPECT_EQ(std::vector<Index>(rings[1].begin(), rings[1].end()), (std::vector<Index>{0, 2}));
}

TEST(Topology, RowsOfVerticesMatchBruteForce) {
  for (const auto& [name, mesh] : sound()) {
    const auto of_vertices = trianglesOfVertices(mesh);
    const auto rings = neighboursOfVertices(mesh, of_vertices);
    for (Index v = 0; v < mesh.positions.size(); ++v) {
      std::vector<Index> triangles;
      std::set<Index> ring;
      for (Index t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle& corners = mesh.triangles[t];
        if (std::find(corners.begin(), corners.end(), v) == corners.end()) continue;
        triangles.push_back(t);
        ring.insert(corners.begin(), corners.end());
      }
      ring.erase(v);
      ASSERT_TRUE(std::ranges::equal(of_vertices[v], triangles)) << name << " vertex " << v;
      ASSERT_TRUE(std::ranges::equal(rings[v], ring)) << name << " vertex " << v;
    }
  }
}

TEST(Topology, NeighboursOfTrianglesMatchBruteForce) {
  for (const auto& [name, mesh] : sound()) {
    const auto neighbours = neighboursOfTriangles(mesh);
    for (Index t = 0; t < mesh.triangles.size(); ++t) {
      for (std::size_t i = 0; i < 3; ++i) {
        const Index a = mesh.triangles[t][i];
        const Index b = mesh.triangles[t][(i + 1) % 3];
        Index same_way = 0;
        std::vector<Index> other_way;
        for (Index other = 0; other < mesh.triangles.size(); ++other) {
          for (std::size_t j = 0; j < 3; ++j) {
            const auto edge = std::pair(mesh.triangles[other][j], mesh.triangles[other][(j + 1) % 3]);
            same_way += edge == std::pair(a, b) ? 1 : 0;
            if (edge == std::pair(b, a)) other_way.push_back(other);
          }
        }
        const bool is_manifold = same_way == 1 && other_way.size() == 1;
        ASSERT_EQ(neighbours[t][i], is_manifold ? other_way[0] : kNoIndex) << name << " triangle " << t;
      }
    }
  }
}

TEST(Topology, EveryEdgeIsVisitedOnceWithAllItsTriangles) {
  const auto mesh = zoo::cubesSharingAnEdge();
  std::size_t edges = 0;
  std::size_t uses = 0;
  std::size_t most = 0;
  forEachEdge(edgeUses(mesh), [&](Index low, Index high, std::span<const EdgeUse> at_edge) {
    EXPECT_LT(low, high);
    for (const EdgeUse& use : at_edge) {
      EXPECT_EQ(std::min(halfEdgeStart(mesh, use.half_edge), halfEdgeEnd(mesh, use.half_edge)), low);
    }
    ++edges;
    uses += at_edge.size();
    most = std::max(most, at_edge.size());
  });
  EXPECT_EQ(edges, 2u * 18u - 1u);
  EXPECT_EQ(uses, 24u * 3u);
  EXPECT_EQ(most, 4u);
}

TEST(Normals, OfASphereMeetItsRadius) {
  const auto mesh = zoo::sphere(20, 4);
  const auto normals = vertexNormals(mesh);
  for (std::size_t v = 0; v < normals.size(); ++v) {
    EXPECT_NEAR(normals[v].norm(), 1.0, 1e-12);
    EXPECT_GT(normals[v].dot(mesh.positions[v].normalized()), 0.9999);
  }
}

TEST(Normals, WeighTrianglesByTheirArea) {
  // Around vertex 0: area 0.5 facing +z, area 2 facing +x.
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 0, 2}}, {{0, 1, 2}, {0, 3, 4}}};
  EXPECT_LT((vertexNormals(mesh)[0] - Vec3(4, 0, 1).normalized()).norm(), 1e-15);
  EXPECT_EQ(triangleNormals(mesh)[1], Vec3(1, 0, 0));
  EXPECT_EQ(vertexNormals(zoo::cubeWithUnusedVertices())[4], Vec3::Zero().eval());
}

}  // namespace palpate::mesh
