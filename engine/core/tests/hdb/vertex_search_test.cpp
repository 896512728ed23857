// The octree as a search for vertices finds the corners of every triangle whose box meets the box, each once.
#include "palpate/hdb/vertex_search.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "core/tests/hdb/partition_judges.h"
#include "support/mesh_zoo.h"

namespace palpate::hdb {
namespace {

TEST(VertexSearch, FindsTheCornersOfAllThatAskingEveryTriangleFinds) {
  for (const mesh::TriangleMesh& mesh : {zoo::torus(), zoo::sphere()}) {
    VertexSearch search(mesh, 8);
    Random random(3);
    for (int i = 0; i < 200; ++i) {
      const Box3 box = test::randomBox(random, mesh);
      std::set<Index> corners;
      for (const Index t : test::trianglesMeeting(mesh, box)) {
        corners.insert(mesh.triangles[t].begin(), mesh.triangles[t].end());
      }
      const auto found = search.find(box);
      EXPECT_EQ(std::set<Index>(found.begin(), found.end()), corners) << i;
      EXPECT_EQ(found.size(), corners.size()) << "a vertex twice, box " << i;
    }
  }
}

TEST(VertexSearch, ABoxWithoutEndHoldsAllAndOneBesideNothing) {
  const mesh::TriangleMesh mesh = zoo::sphere();
  VertexSearch search(mesh);
  constexpr double kFar = std::numeric_limits<double>::infinity();
  EXPECT_EQ(search.find(Box3(Vec3::Constant(-kFar), Vec3::Constant(kFar))).size(), mesh.positions.size());
  EXPECT_TRUE(search.find(Box3(Vec3::Constant(1e6), Vec3::Constant(2e6))).empty());
  EXPECT_EQ(search.find(Box3(Vec3::Constant(-kFar), Vec3::Constant(kFar))).size(), mesh.positions.size());
}

}  // namespace
}  // namespace palpate::hdb
