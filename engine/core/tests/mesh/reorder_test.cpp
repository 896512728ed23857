#include "palpate/mesh/reorder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "palpate/base/environment.h"
#include "palpate/base/random.h"
#include "support/mesh_zoo.h"

namespace palpate::mesh {

TriangleMesh shuffled(TriangleMesh mesh) {
  Random random(5);
  for (std::size_t t = mesh.triangles.size() - 1; t > 0; --t) {
    std::swap(mesh.triangles[t], mesh.triangles[random.below(t + 1)]);
  }
  return mesh;
}

TEST(Reorder, KeepsTheSurfaceAndSaysWhereEverythingCameFrom) {
  const TriangleMesh before = shuffled(zoo::wavyGrid(20));
  TriangleMesh after = before;
  const Reordering order = reorderSpatially(after);
  ASSERT_EQ(after.triangles.size(), before.triangles.size());
  ASSERT_EQ(after.positions.size(), before.positions.size());
  for (std::size_t v = 0; v < after.positions.size(); ++v) {
    EXPECT_EQ(after.positions[v], before.positions[order.source_vertex[v]]);
  }
  for (std::size_t t = 0; t < after.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(order.source_vertex[after.triangles[t][i]], before.triangles[order.source_triangle[t]][i]);
    }
  }
}

/// Mean distance between the centres of triangles that follow each other.
double meanStep(const TriangleMesh& mesh) {
  const auto centres = triangleCentres(mesh);
  double sum = 0.0;
  for (std::size_t i = 1; i < centres.size(); ++i) sum += (centres[i] - centres[i - 1]).norm();
  return sum / static_cast<double>(centres.size() - 1);
}

TEST(Reorder, PutsNearTrianglesNextToEachOther) {
  TriangleMesh mesh = shuffled(zoo::wavyGrid(100, 100.0));
  EXPECT_GT(meanStep(mesh), 40.0);
  reorderSpatially(mesh);
  EXPECT_LT(meanStep(mesh), 2.0);  // cells are 1 mm wide
}

std::vector<Index> groupedBy(const std::vector<Vec3>& points, const std::vector<Index>& order,
                             std::size_t (*threads)()) {
  const Environment before = environment();
  Environment own = before;
  own.processors = threads;
  useEnvironment(own);
  std::vector<Index> grouped = inCompactGroups(points, order);
  useEnvironment(before);
  return grouped;
}

TEST(Reorder, MakesTheSameGroupsByOneThreadAndByFive) {
  Random random(8);
  std::vector<Vec3> points(150'000);  // shared out from 50,000 on
  for (Vec3& point : points) point = Vec3(random.uniform(0, 400), random.uniform(0, 300), random.uniform(0, 9));
  std::vector<Index> order(points.size());
  std::iota(order.begin(), order.end(), Index{0});
  EXPECT_EQ(groupedBy(points, order, [] { return std::size_t{1}; }),
            groupedBy(points, order, [] { return std::size_t{5}; }));
}

TEST(Reorder, IsStableOnPointsThatCannotBeTold) {
  const std::vector<Vec3> same(5, Vec3(1, 2, 3));
  EXPECT_EQ(mortonOrder(same), (std::vector<Index>{0, 1, 2, 3, 4}));
  EXPECT_TRUE(mortonOrder({}).empty());
}

}  // namespace palpate::mesh
