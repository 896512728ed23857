// Scans in map coordinates: a body is deformed as the same body near the origin is, wherever it lies.
#include <gtest/gtest.h>

#include "core/tests/deform/stage.h"

namespace palpate::test {

namespace {

mesh::TriangleMesh movedBy(mesh::TriangleMesh mesh, const Vec3& offset) {
  for (Vec3& position : mesh.positions) position += offset;
  return mesh;
}

const std::vector<Vec3> kFarPlaces = {{4e8, 4e8, 0.0}, {5e8, 4.08e9, 1e6}, {-2e10, 2e10, -3e4}};

}  // namespace

TEST(FarBody, IsDeformedAsTheSameBodyNearTheOrigin) {
  for (const Way way : {Way::chosen, Way::general}) {
    Stage near(torso(), {}, way);
    const Index triangle = triangleNear(near.mesh, Vec3(40.0, 60.0, 90.0));
    const auto pressed = [&](const mesh::TriangleMesh& mesh) {
      return std::vector<Contact>{drag(press(mesh, triangle, 9.0), Vec3(12.0, 5.0, 0.0))};
    };
    near.apply(pressed(near.mesh));
    for (const Vec3& place : kFarPlaces) {
      Stage far(movedBy(torso(), place), {}, way);
      const Report report = far.apply(pressed(far.mesh));
      EXPECT_EQ(report.status, 0u);
      for (Index v = 0; v < near.surface.vertices(); ++v) {
        ASSERT_LT((far.moved(v) - near.moved(v)).norm(), 2e-3) << v << " at " << place.transpose();
        const Vec3 expected = far.mesh.positions[v] + near.moved(v);
        ASSERT_LT((far.surface.placeAt(v) - expected).norm(), 2e-3) << v << " at " << place.transpose();
      }
    }
  }
}

TEST(FarBody, ABodyWithinTenMetresCountsFromTheOriginItself) {
  EXPECT_EQ(Stage(movedBy(torso(), Vec3(9000.0, -9000.0, 0.0))).skin.origin, Vec3(0, 0, 0));
  EXPECT_EQ(Stage(movedBy(torso(), Vec3(20000.0, 0.0, 0.4))).skin.origin, Vec3(20000.0, 0.0, 0.0));
}

}  // namespace palpate::test
