#include "palpate/tree/triangle_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "palpate/base/random.h"
#include "support/mesh_zoo.h"
#include "support/winding_number.h"

namespace palpate::tree {

namespace {

Vec3 somewhere(Random& random, const TriangleTree& tree) {
  const auto coordinate = [&] { return 0.4 * random.uniform(-tree.diagonal, tree.diagonal); };
  const double x = coordinate(), y = coordinate(), z = coordinate();
  return tree.center + Vec3(x, y, z);
}

}  // namespace

TEST(WindingNumber, CountsTheSheetsAroundAPoint) {
  const TriangleTree tree = buildTriangleTree(zoo::overlappingSpheres());
  const Vec3 middle = tree.center;
  EXPECT_NEAR(windingNumber(tree, middle), 2.0, 0.05);
  EXPECT_NEAR(windingNumber(tree, middle + Vec3(20, 0, 0)), 1.0, 0.05);
  EXPECT_NEAR(windingNumber(tree, middle - Vec3(20, 0, 0)), 1.0, 0.05);
  EXPECT_NEAR(windingNumber(tree, middle + Vec3(0, 19, 0)), 0.0, 0.05);
  EXPECT_NEAR(windingNumber(tree, middle + Vec3(0, 0, -40)), 0.0, 0.05);
}

TEST(WindingNumber, IsThatOfTheExactSumOverAllTriangles) {
  Random random(5);
  struct Case {
    std::string name;
    mesh::TriangleMesh mesh;
  };
  const Case cases[] = {{"sphere", zoo::sphere(20.0, 5)},        {"torus", zoo::torus(20.0, 6.0, 96, 48)},
                        {"thin plate", zoo::plate(50.0, 0.1)},   {"open tube", zoo::openTube()},
                        {"cube with a fin", zoo::cubeWithFin()}, {"hollow sphere", zoo::hollowSphere(4)},
                        {"inside out", zoo::insideOut()},        {"far away", zoo::sphere(0.02, 4, {4e4, 1e5, -3e4})}};
  for (const auto& [name, mesh] : cases) {
    const TriangleTree tree = buildTriangleTree(mesh);
    double worst = 0.0;
    for (int i = 0; i < 2000; ++i) {
      const Vec3 point = somewhere(random, tree);
      worst = std::max(worst, std::abs(windingNumber(tree, point) - support::windingNumber(mesh, point)));
    }
    EXPECT_LT(worst, 0.05) << name;
  }
}

TEST(WindingNumber, TellsTheTwoSidesOfASkinAHairApart) {
  const mesh::TriangleMesh mesh = zoo::torus(20.0, 6.0, 96, 48);
  const TriangleTree tree = buildTriangleTree(mesh);
  for (const TriangleRecord& record : tree.records) {
    const Vec3 normal = mesh::areaVector2(record.corners[0], record.corners[1], record.corners[2]).normalized();
    const Vec3 place = (record.corners[0] + record.corners[1] + record.corners[2]) / 3.0;
    const double hair = 1e-9 * tree.diagonal;
    ASSERT_NEAR(windingNumber(tree, place + hair * normal), 0.0, 0.05);
    ASSERT_NEAR(windingNumber(tree, place - hair * normal), 1.0, 0.05);
  }
}

}  // namespace palpate::tree
