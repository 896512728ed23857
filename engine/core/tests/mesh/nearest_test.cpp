// The nearest point of a mesh, against closed forms and against looking at every triangle.
#include "palpate/mesh/nearest.h"

#include <gtest/gtest.h>

#include "palpate/base/random.h"
#include "support/mesh_zoo.h"

namespace palpate::mesh {
namespace {

Vec3 randomPoint(Random& random, double reach) {
  return {random.uniform(-reach, reach), random.uniform(-reach, reach), random.uniform(-reach, reach)};
}

TEST(NearestOnTriangle, PicksCornerEdgeOrFace) {
  const Vec3 a(0, 0, 0);
  const Vec3 b(10, 0, 0);
  const Vec3 c(0, 10, 0);
  EXPECT_TRUE(nearestOnTriangle({-3, -3, 1}, a, b, c).isApprox(a) ||
              nearestOnTriangle({-3, -3, 1}, a, b, c).norm() == 0);
  EXPECT_TRUE(nearestOnTriangle({15, -2, 1}, a, b, c).isApprox(b));
  EXPECT_TRUE(nearestOnTriangle({-2, 15, 1}, a, b, c).isApprox(c));
  EXPECT_TRUE(nearestOnTriangle({4, -2, 1}, a, b, c).isApprox(Vec3(4, 0, 0)));
  EXPECT_TRUE(nearestOnTriangle({10, 10, 3}, a, b, c).isApprox(Vec3(5, 5, 0)));
  EXPECT_TRUE(nearestOnTriangle({2, 3, -7}, a, b, c).isApprox(Vec3(2, 3, 0)));
}

TEST(NearestTriangle, AgreesWithLookingAtEveryTriangle) {
  Random random(7);
  for (const TriangleMesh& mesh : {zoo::torus(), zoo::wavyGrid(), zoo::cube(), zoo::oneTriangle()}) {
    const NearestTriangle tree(mesh);
    for (int i = 0; i < 200; ++i) {
      const Vec3 p = randomPoint(random, 60.0);
      double nearest = 1e300;
      for (const Triangle& t : mesh.triangles) {
        const Vec3 q = nearestOnTriangle(p, mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
        nearest = std::min(nearest, (q - p).norm());
      }
      const NearestTriangle::Hit hit = tree.find(p);
      EXPECT_DOUBLE_EQ(hit.distance, nearest);
      EXPECT_DOUBLE_EQ((hit.point - p).norm(), hit.distance);
    }
  }
}

TEST(NearestTriangle, FindsNothingBeyondItsReach) {
  const NearestTriangle tree(zoo::cube());
  EXPECT_EQ(tree.find({5, 5, 15}, 4.9).triangle, kNoIndex);
  EXPECT_NE(tree.find({5, 5, 15}, 5.1).triangle, kNoIndex);
}

TEST(NearestTriangle, OfAnEmptyMeshFindsNothing) {
  EXPECT_EQ(NearestTriangle(TriangleMesh{}).find({0, 0, 0}).triangle, kNoIndex);
}

}  // namespace
}  // namespace palpate::mesh
