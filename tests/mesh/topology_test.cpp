#include "palpate/mesh/topology.h"

#include <gtest/gtest.h>

namespace palpate::mesh {

// A square of two triangles: 0-1-2 and 0-2-3.
TriangleMesh square() { return {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}}; }

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

}  // namespace palpate::mesh
