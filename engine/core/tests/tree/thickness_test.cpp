// How thick bodies of known measures are under their vertices.
#include "palpate/tree/triangle_tree.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/mesh_zoo.h"

namespace palpate::tree {
namespace {

std::vector<float> thicknessOf(const mesh::TriangleMesh& mesh, const std::vector<Vec3>& normals, double most_mm) {
  return thicknessUpTo(buildTriangleTree(mesh), mesh.positions, normals, most_mm);
}

TEST(Thickness, IsTheTubesDiameterAllOverARing) {
  constexpr double kRing = 30.0, kTube = 3.0;
  const mesh::TriangleMesh ring = zoo::torus(kRing, kTube, 128, 64);
  std::vector<Vec3> normals;
  for (const Vec3& p : ring.positions) {
    const Vec3 middle = kRing * Vec3(p.x(), p.y(), 0).normalized();
    normals.push_back((p - middle).normalized());
  }
  for (const float mm : thicknessOf(ring, normals, 11.0)) EXPECT_NEAR(mm, 2.0 * kTube, 0.02);
  for (const float mm : thicknessOf(ring, normals, 5.5)) EXPECT_TRUE(std::isinf(mm)) << "thicker than was asked for";
}

TEST(Thickness, IsThatOfTheNearestPartWhereSeveralLieBehindEachOther) {
  const mesh::TriangleMesh two = zoo::joined(zoo::cube(2.0), zoo::cube(2.0, Vec3(0, 0, -4)));
  const std::vector<Vec3> normals(two.positions.size(), -Vec3(0.1, 0.15, -1).normalized());
  const std::vector<float> thickness = thicknessOf(two, normals, 8.0);
  for (std::size_t v = 0; v < two.positions.size(); ++v) {
    if (two.positions[v] != Vec3(0, 0, 2)) continue;
    EXPECT_NEAR(thickness[v], 2.0 * Vec3(0.1, 0.15, -1).norm(), 1e-3) << "a corner of the upper cube";
  }
}

TEST(Thickness, IsNotKnownWhereThereIsNoDirection) {
  const mesh::TriangleMesh cube = zoo::cube(2.0);
  for (const Vec3& none : {Vec3(0, 0, 0), Vec3(std::nan(""), 0, 0)}) {
    for (const float mm : thicknessOf(cube, std::vector<Vec3>(cube.positions.size(), none), 8.0)) {
      EXPECT_TRUE(std::isinf(mm));
    }
  }
}

}  // namespace
}  // namespace palpate::tree
