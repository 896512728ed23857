// The quick winding number beside the exact sum over all triangles, near, far, inside and outside.
#include "lab/judges/fast_winding.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lab/judges/surface_side.h"
#include "lab/workloads/heldout_meshes.h"
#include "lab/workloads/hunted_bodies.h"
#include "palpate/base/random.h"

namespace palpate::lab {
namespace {

/// Largest difference from the exact sum at points in the body's box and as far round it again.
double largestError(const mesh::TriangleMesh& mesh, std::uint64_t seed) {
  const BoxTree tree(mesh);
  const FastWinding fast(tree);
  const Box3 box = mesh::boundingBox(mesh);
  Random random(seed);
  double largest = 0.0;
  for (int i = 0; i < 300; ++i) {
    const Vec3 share = random.uniform3(-0.5, 1.5);
    const Vec3 point = box.min() + share.cwiseProduct(box.diagonal());
    largest = std::max(largest, std::abs(fast.at(point) - windingNumber(mesh, point)));
  }
  return largest;
}

TEST(FastWinding, AgreesWithTheExactSumOnClosedTornAndOverlappingBodies) {
  for (const char* kind : {"limbs", "pocket", "plates", "hollow", "leaf", "two_parts", "pierced", "open_sheet"})
    EXPECT_LT(largestError(huntedBody(kind, 3), 5), 0.02) << kind;
}

TEST(FastWinding, TellsInsideFromOutsideAMicronFromTheSkin) {
  const mesh::TriangleMesh mesh = bumpyBallMesh(60, 0.08, 9, 4);
  const BoxTree tree(mesh);
  const FastWinding fast(tree);
  for (const Triangle& t : mesh.triangles) {
    const auto& [a, b, c] = std::array{mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
    const Vec3 out = 1e-3 * mesh::areaVector2(a, b, c).normalized(), middle = (a + b + c) / 3.0;
    ASSERT_LT(fast.at(middle + out), 0.1);
    ASSERT_GT(fast.at(middle - out), 0.9);
  }
}

TEST(FastWinding, CountsTwoWhereTwoBodiesOverlapAndNothingInAHollow) {
  const mesh::TriangleMesh balls = overlappingBallsMesh();
  const BoxTree tree(balls);
  EXPECT_NEAR(FastWinding(tree).at({0, 0, 0}), 2.0, 0.02);
  mesh::TriangleMesh hollow = bumpyBallMesh(50, 0, 0, 4), inner = bumpyBallMesh(30, 0, 0, 4);
  for (Triangle& t : inner.triangles) std::swap(t[1], t[2]);
  mesh::append(inner, hollow);
  const BoxTree hollow_tree(hollow);
  EXPECT_NEAR(FastWinding(hollow_tree).at({0, 0, 0}), 0.0, 0.02);
  EXPECT_NEAR(FastWinding(hollow_tree).at({0, 40, 0}), 1.0, 0.02);
}

}  // namespace
}  // namespace palpate::lab
