// The scan that the program makes: what a scan with a hole is, and the same each time.
#include "palpate/body/fitting/made_scan.h"

#include <gtest/gtest.h>

#include "palpate/mesh/repair.h"
#include "palpate/mesh/validate.h"

namespace palpate::body {
namespace {

TEST(MadeScan, IsAnOpenBackWithAHoleThatRepairLeaves) {
  const mesh::RepairResult mended = mesh::repair(makeScan());
  EXPECT_FALSE(mended.closed);
  EXPECT_GT(mended.mesh.triangles.size(), 9000u);
  const Eigen::AlignedBox3d box = mesh::boundingBox(mended.mesh);
  EXPECT_GT(box.sizes().x(), 300.0);
  EXPECT_GT(box.sizes().y(), 340.0);
  const auto has_skin_at = [&](double x, double y) {
    for (const Vec3& place : mended.mesh.positions) {
      if ((place.head<2>() - Vec2(x, y)).norm() < 12.0) return true;
    }
    return false;
  };
  EXPECT_FALSE(has_skin_at(62.0, -48.0)) << "the hole";
  EXPECT_TRUE(has_skin_at(-62.0, -48.0)) << "and none on the other side";
}

TEST(MadeScan, IsTheSameEachTime) {
  const mesh::TriangleMesh a = makeScan();
  const mesh::TriangleMesh b = makeScan();
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.positions, b.positions);
}

}  // namespace
}  // namespace palpate::body
