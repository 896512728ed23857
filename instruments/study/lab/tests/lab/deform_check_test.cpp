// The judge of deformations is judged with skin that is moved wrongly on purpose.
#include "lab/judges/deform_check.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/mesh_zoo.h"

namespace palpate::lab {
namespace {

/// A grid with vertices 5 mm apart, touched in its middle, moved vertex by vertex.
struct JudgedGrid {
  mesh::TriangleMesh mesh = zoo::grid(20, 100.0);
  std::vector<Vec3f> positions;
  lab::TouchedPlace place;

  JudgedGrid() {
    for (const Vec3& p : mesh.positions) positions.push_back(p.cast<float>());
    for (Index t = 0; t < mesh.triangles.size(); ++t) {
      if ((centreOf(mesh, mesh.triangles[t]) - Vec3(51, 51, 0)).norm() < 3.0) place.triangle = t;
    }
    place.anchor = centreOf(mesh, mesh.triangles[place.triangle]);
    place.farthest_off_plane_mm = 1.0;
  }
  /// A dent with straight flanks.
  void dent(double radius, double depth) {
    for (std::size_t v = 0; v < positions.size(); ++v) {
      const double away = (mesh.positions[v] - place.anchor).norm() / radius;
      if (away < 1.0) positions[v].z() -= static_cast<float>(depth * (1.0 - away));
    }
  }
  lab::DeformReport judge() const { return lab::checkDeformation(mesh, positions, {&place, 1}); }
};

TEST(DeformCheck, ADentIsSound) {
  JudgedGrid grid;
  EXPECT_EQ(grid.judge().moved, 0u);
  grid.dent(20.0, 8.0);
  const lab::DeformReport report = grid.judge();
  EXPECT_TRUE(report.isSound());
  EXPECT_GT(report.moved, 30u);
  EXPECT_EQ(report.too_thin, 0u);
  EXPECT_EQ(report.longest_tear_mm, 0.0);
}

TEST(DeformCheck, SeesSkinThatMovesElsewhere) {
  JudgedGrid grid;
  grid.dent(20.0, 8.0);
  grid.positions[0].z() -= 0.1f;
  EXPECT_EQ(grid.judge().unconnected, 1u);
}

TEST(DeformCheck, SeesSkinOffThePlane) {
  JudgedGrid grid;
  for (Vec3& p : grid.mesh.positions) p.z() = -0.2 * std::abs(p.x() - 51.0);
  for (std::size_t v = 0; v < grid.positions.size(); ++v) grid.positions[v] = grid.mesh.positions[v].cast<float>();
  grid.dent(20.0, 3.0);
  EXPECT_EQ(grid.judge().unconnected, 0u);
  EXPECT_GT(grid.judge().off_plane, 0u);
}

TEST(DeformCheck, SeesTrianglesThatTurnOverAndTears) {
  JudgedGrid grid;
  const Index moved = grid.mesh.triangles[grid.place.triangle][0];
  grid.positions[moved].x() += 12.0f;
  const lab::DeformReport report = grid.judge();
  EXPECT_GT(report.turned, 0u);
  EXPECT_NEAR(report.longest_tear_mm, 7.0, 1e-5);
}

TEST(DeformCheck, SeesATriangleThatVanishes) {
  JudgedGrid grid;
  const Triangle& t = grid.mesh.triangles[grid.place.triangle];
  for (const Index v : t) grid.positions[v] = grid.positions[t[0]];
  EXPECT_GT(grid.judge().turned, 0u);
}

TEST(DeformCheck, DoesNotJudgeWhatFloatsCannotTell) {
  mesh::TriangleMesh thin{{{1000, 0, 0}, {1010, 0, 0}, {1005, 1e-6, 0}}, {{0, 1, 2}}};
  const std::vector<Vec3f> moved{{1000, 0, 0}, {1010, 0, 0}, {1005, -1e-6f, 0}};
  const lab::TouchedPlace place{{1000, 0, 0}, 0, Vec3::UnitZ(), 1.0};
  const lab::DeformReport report = lab::checkDeformation(thin, moved, {&place, 1});
  EXPECT_EQ(report.too_thin, 1u);
  EXPECT_EQ(report.turned, 0u);
}

}  // namespace
}  // namespace palpate::lab
