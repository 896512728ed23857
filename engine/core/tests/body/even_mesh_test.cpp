#include "palpate/body/trunk/even_mesh.h"

#include <gtest/gtest.h>

#include <cmath>

#include "palpate/base/error.h"
#include "palpate/body/tetrahedra_mesher.h"
#include "palpate/mesh/validate.h"

namespace palpate::body {
namespace {

constexpr double kRadius = 100;

SkinPoint ontoSphere(const Vec3& p) { return {kRadius * p.normalized(), p.normalized()}; }

mesh::TriangleMesh meshSphere(std::size_t triangles) {
  const Field distance = [](const Vec3& p) { return p.norm() - kRadius; };
  const mesh::TriangleMesh rough =
      meshZeroSurface(distance, {.low = Vec3::Constant(-110), .high = Vec3::Constant(110), .cell_mm = 15});
  return evenMesh(rough, ontoSphere, triangles);
}

/// Twice the height over the longest side: 1 is equilateral.
double shapeOf(const mesh::TriangleMesh& mesh, const Triangle& t) {
  const Vec3& a = mesh.positions[t[0]];
  const Vec3& b = mesh.positions[t[1]];
  const Vec3& c = mesh.positions[t[2]];
  const double longest = std::max({(a - b).norm(), (b - c).norm(), (c - a).norm()});
  return mesh::areaVector2(a, b, c).norm() / (longest * longest * std::sqrt(0.75));
}

TEST(EvenMesh, HasExactlyTheTrianglesAskedForAndIsSound) {
  for (const std::size_t triangles : {100u, 2000u, 2002u, 50000u, 50006u}) {
    const mesh::TriangleMesh sphere = meshSphere(triangles);
    EXPECT_EQ(sphere.triangles.size(), triangles);
    EXPECT_TRUE(mesh::validate(sphere).sound()) << triangles;
  }
}

TEST(EvenMesh, TrianglesAreAlikeInSizeAndNearlyEquilateral) {
  const mesh::TriangleMesh sphere = meshSphere(60000);
  const double mean = 4 * 3.14159265 * kRadius * kRadius / 60000;
  double worst_shape = 1;
  double squares = 0;
  for (const Triangle& t : sphere.triangles) {
    worst_shape = std::min(worst_shape, shapeOf(sphere, t));
    const double area =
        mesh::areaVector2(sphere.positions[t[0]], sphere.positions[t[1]], sphere.positions[t[2]]).norm() / 2;
    squares += (area / mean - 1) * (area / mean - 1);
  }
  EXPECT_GT(worst_shape, 0.4);
  EXPECT_LT(std::sqrt(squares / 60000), 0.15);
}

TEST(EvenMesh, LiesOnTheSurface) {
  for (const Vec3& p : meshSphere(50000).positions) ASSERT_NEAR(p.norm(), kRadius, 1e-9);
}

TEST(EvenMesh, IsTheSameEveryTime) {
  const mesh::TriangleMesh one = meshSphere(3000);
  const mesh::TriangleMesh other = meshSphere(3000);
  EXPECT_EQ(one.triangles, other.triangles);
  for (std::size_t v = 0; v < one.positions.size(); ++v) ASSERT_EQ(one.positions[v], other.positions[v]);
}

}  // namespace
}  // namespace palpate::body
