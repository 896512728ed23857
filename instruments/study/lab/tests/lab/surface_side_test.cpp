#include "lab/judges/surface_side.h"

#include <gtest/gtest.h>

#include <limits>

#include "lab/workloads/workload_meshes.h"
#include "palpate/base/random.h"

namespace palpate::lab {
namespace {

mesh::TriangleMesh box(const Vec3& low, const Vec3& high) {
  mesh::TriangleMesh m;
  for (int i = 0; i < 8; ++i) {
    m.positions.emplace_back((i & 1) != 0 ? high.x() : low.x(), (i & 2) != 0 ? high.y() : low.y(),
                             (i & 4) != 0 ? high.z() : low.z());
  }
  m.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                 {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return m;
}

/// A box without its lid, standing on its head: open, and no height field.
mesh::TriangleMesh bell() {
  mesh::TriangleMesh m = box({0, 0, 0}, {10, 10, 10});
  m.triangles.erase(m.triangles.begin(), m.triangles.begin() + 2);
  return m;
}

TEST(SurfaceSide, ChoosesItsMethodByTheMesh) {
  EXPECT_EQ(lab::SurfaceSide(lab::flatMesh()).kind(), lab::SurfaceKind::height_field);
  EXPECT_EQ(lab::SurfaceSide(lab::grooveMesh(60)).kind(), lab::SurfaceKind::height_field);
  EXPECT_EQ(lab::SurfaceSide(box({0, 0, 0}, {1, 1, 1})).kind(), lab::SurfaceKind::closed);
  EXPECT_EQ(lab::SurfaceSide(bell()).kind(), lab::SurfaceKind::open);
}

TEST(SurfaceSide, WindingNumberIsOneInsideAndZeroOutside) {
  const mesh::TriangleMesh m = box({0, 0, 0}, {10, 20, 30});
  EXPECT_NEAR(lab::windingNumber(m, {1, 19, 29}), 1.0, 1e-12);
  EXPECT_NEAR(lab::windingNumber(m, {-1, 19, 29}), 0.0, 1e-12);
}

TEST(SurfaceSide, KnowsTheInsideOfAClosedBody) {
  lab::SurfaceSide side(box({0, 0, 0}, {10, 10, 10}));
  Random random(1);
  for (int i = 0; i < 5000; ++i) {
    const Vec3 p = random.uniform3(-5, 15);
    const bool inside = p.minCoeff() > 0 && p.maxCoeff() < 10;
    ASSERT_EQ(side.sideOf(p), inside ? lab::Side::inside : lab::Side::outside) << p.transpose();
  }
  EXPECT_EQ(side.sideOf({5, 5, 10}), lab::Side::on_surface);
}

TEST(SurfaceSide, HeightAgreesWithTheFunctionAtVertices) {
  const mesh::TriangleMesh m = lab::backMesh(2962);
  const lab::SurfaceSide side(m);
  for (const Vec3& p : m.positions) {
    ASSERT_TRUE(side.heightAt(p.x(), p.y())) << p.transpose();
    EXPECT_NEAR(*side.heightAt(p.x(), p.y()), p.z(), 1e-6);
  }
}

TEST(SurfaceSide, HeightFieldIsUnknownBeyondItsBorderAndBesideIt) {
  lab::SurfaceSide side(lab::flatMesh());
  EXPECT_EQ(side.sideOf({50, 50, 1}), lab::Side::outside);
  EXPECT_EQ(side.sideOf({50, 50, -5}), lab::Side::inside);
  EXPECT_EQ(side.sideOf({50, 50, 0}), lab::Side::on_surface);
  EXPECT_EQ(side.sideOf({101, 50, -5}), lab::Side::unknown);
  EXPECT_EQ(side.sideOf({101, 50, 5}), lab::Side::unknown);
  EXPECT_EQ(side.sideOf({97, 50, -5}), lab::Side::unknown) << "nearer to the border than deep";
}

TEST(SurfaceSide, OpenSurfaceUsesTheNearestPoint) {
  lab::SurfaceSide side(bell());
  EXPECT_EQ(side.sideOf({5, 5, 9}), lab::Side::inside);
  EXPECT_EQ(side.sideOf({5, 5, 11}), lab::Side::outside);
  EXPECT_EQ(side.sideOf({-1, -1, 11}), lab::Side::outside) << "the pseudo-normal of a corner";
  EXPECT_EQ(side.sideOf({-1, 5, -3}), lab::Side::unknown) << "nearest to the border";
}

TEST(SurfaceSide, NearestPointAgreesWithAskingEveryTriangle) {
  const mesh::TriangleMesh m = lab::backMesh(500);
  lab::SurfaceSide tree(m);
  Random random(2);
  for (int i = 0; i < 300; ++i) {
    const Vec3 p(random.uniform(-50, 400), random.uniform(-50, 450), random.uniform(-50, 200));
    double brute = std::numeric_limits<double>::infinity();
    for (const Triangle& t : m.triangles) {  // a lattice on each triangle bounds the distance from above
      for (int a = 0; a <= 20; ++a) {
        for (int b = 0; a + b <= 20; ++b) {
          const Vec3 q = (a * m.positions[t[0]] + b * m.positions[t[1]] + (20 - a - b) * m.positions[t[2]]) / 20.0;
          brute = std::min(brute, (q - p).norm());
        }
      }
    }
    const lab::NearestPoint nearest = tree.nearestTo(p);
    ASSERT_LE(nearest.distance, brute + 1e-9);
    ASSERT_GE(nearest.distance, brute - 1.5) << "lattice points are at most 1.5 mm from any point of a triangle";
    ASSERT_NEAR((nearest.point - p).norm(), nearest.distance, 1e-12);
  }
}

}  // namespace
}  // namespace palpate::lab
