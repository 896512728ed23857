#include <gtest/gtest.h>

#include <algorithm>

#include "palpate/mesh/topology.h"
#include "support/mesh_zoo.h"

namespace palpate {

std::size_t borderEdges(const mesh::TriangleMesh& mesh) {
  std::size_t count = 0;
  for (const auto& row : mesh::neighboursOfTriangles(mesh)) count += std::count(row.begin(), row.end(), kNoIndex);
  return count;
}

TEST(MeshZoo, ClosedOnesAreClosed) {
  for (const auto& mesh : {zoo::cube(), zoo::sphere(), zoo::torus(), zoo::plate(), zoo::hollowSphere()}) {
    EXPECT_EQ(borderEdges(mesh), 0u);
  }
  EXPECT_EQ(zoo::sphere(20, 3).triangles.size(), 1280u);
}

TEST(MeshZoo, OpenOnesHaveTheirBorders) {
  EXPECT_EQ(borderEdges(zoo::grid(8)), 32u);
  EXPECT_EQ(borderEdges(zoo::openTube(10, 40, 24, 8)), 48u);
  EXPECT_EQ(borderEdges(zoo::oneTriangle()), 3u);
}

TEST(MeshZoo, HugeGridHasTheAskedSize) {
  const auto mesh = zoo::hugeGrid(100'000);
  EXPECT_GE(mesh.triangles.size(), 100'000u);
  EXPECT_LT(mesh.triangles.size(), 101'000u);
}

}  // namespace palpate
