// Surfaces from distances: closed for any shape, on the surface, the same with and without skipping blocks.
#include "palpate/body/tetrahedra_mesher.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "palpate/body/signed_distance.h"
#include "palpate/mesh/validate.h"

namespace palpate::body {
namespace {

MesherSettings cube(double half, double cell) {
  MesherSettings settings;
  settings.low = Vec3::Constant(-half - 0.3);  // off the lattice of round numbers
  settings.high = Vec3::Constant(half);
  settings.cell_mm = cell;
  return settings;
}

double ball(const Vec3& p) { return p.norm() - 10.0; }

// A plate thinner than two cells, slanted, with a hole: where table-based methods leave non-manifold edges.
double thinPlate(const Vec3& p) {
  const Vec3 q = Eigen::AngleAxisd(0.3, Vec3(1, 2, 3).normalized()) * p;
  const double plate = std::max({std::abs(q.x()) - 12.0, std::abs(q.y()) - 9.0, std::abs(q.z()) - 0.9});
  return smoothDifference(plate, std::hypot(q.x(), q.y()) - 3.0, 0.5);
}

TEST(TetrahedraMesher, MeshesABallClosedAndOnItsSurface) {
  const mesh::TriangleMesh mesh = meshZeroSurface(ball, cube(14.0, 1.0));
  const mesh::ValidationReport report = mesh::validate(mesh);
  EXPECT_TRUE(report.closed);
  EXPECT_EQ(report.components, 1u);
  EXPECT_EQ(report.non_manifold_vertices.count, 0u);
  EXPECT_NEAR(report.volume_mm3, 4.0 / 3.0 * std::numbers::pi * 1000.0, 30.0);
  for (const Vec3& p : mesh.positions) EXPECT_NEAR(p.norm(), 10.0, 0.03);
}

TEST(TetrahedraMesher, IsManifoldOnThinPlatesAtAnyGrid) {
  for (const double cell : {0.9, 1.0, 1.1, 1.2, 1.3, 1.7}) {
    const mesh::ValidationReport report = mesh::validate(meshZeroSurface(thinPlate, cube(16.0, cell)), {false});
    EXPECT_TRUE(report.closed) << cell;
    EXPECT_EQ(report.non_manifold_edges.count, 0u) << cell;
    EXPECT_EQ(report.non_manifold_vertices.count, 0u) << cell;
  }
}

TEST(TetrahedraMesher, SkippingBlocksLosesNothing) {
  for (const auto& field : {Field(ball), Field(thinPlate)}) {
    MesherSettings settings = cube(20.0, 0.8);
    const mesh::TriangleMesh quick = meshZeroSurface(field, settings);
    settings.steepest = 1e9;  // visits every block
    const mesh::TriangleMesh full = meshZeroSurface(field, settings);
    EXPECT_EQ(quick.triangles.size(), full.triangles.size());
    EXPECT_DOUBLE_EQ(mesh::validate(quick, {false}).volume_mm3, mesh::validate(full, {false}).volume_mm3);
  }
}

TEST(TetrahedraMesher, FollowsTheSurfaceWhenTheBoundIsWrong) {
  MesherSettings settings = cube(14.0, 1.0);
  settings.steepest = 0.3;  // a lie: the field changes by 1 a millimetre
  const mesh::ValidationReport report = mesh::validate(meshZeroSurface(ball, settings));
  EXPECT_TRUE(report.closed || report.triangles == 0);
}

TEST(TetrahedraMesher, HalfAndItsMirrorImageMakeAClosedWhole) {
  MesherSettings settings = cube(14.0, 1.1);
  settings.low.x() = 0.0;
  const mesh::TriangleMesh whole = withMirrorImage(meshZeroSurface(ball, settings));
  const mesh::ValidationReport report = mesh::validate(whole);
  EXPECT_TRUE(report.closed);
  EXPECT_TRUE(report.components == 1u && report.non_manifold_vertices.count == 0u);
}

TEST(TetrahedraMesher, FindsNothingInAnEmptyField) {
  EXPECT_TRUE(meshZeroSurface([](const Vec3&) { return 1.0; }, cube(5.0, 1.0)).triangles.empty());
}

TEST(RelaxOnSurface, EvensTrianglesAndStaysOnTheSurface) {
  const auto slivers = [](const mesh::TriangleMesh& mesh) {
    std::size_t count = 0;
    for (const Triangle& t : mesh.triangles) {
      const Vec3& a = mesh.positions[t[0]];
      const Vec3& b = mesh.positions[t[1]];
      const Vec3& c = mesh.positions[t[2]];
      const double squares = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
      count += 2.0 * std::sqrt(3.0) * mesh::areaVector2(a, b, c).norm() < 0.2 * squares ? 1 : 0;
    }
    return count;
  };
  mesh::TriangleMesh mesh = meshZeroSurface(ball, cube(14.0, 1.0));
  const std::size_t before = slivers(mesh);
  relaxOnSurface(mesh, ball, 3);
  EXPECT_LT(slivers(mesh), before / 4);
  for (const Vec3& p : mesh.positions) EXPECT_NEAR(p.norm(), 10.0, 1e-6);
}

TEST(RelaxOnSurface, KeepsTheBorderOfAHalfInItsPlane) {
  MesherSettings settings = cube(14.0, 1.1);
  settings.low.x() = 0.0;
  mesh::TriangleMesh half = meshZeroSurface(ball, settings);
  const auto in_plane = [&] {
    return std::count_if(half.positions.begin(), half.positions.end(), [](const Vec3& p) { return p.x() == 0.0; });
  };
  const auto before = in_plane();
  relaxOnSurface(half, ball, 3);
  EXPECT_EQ(in_plane(), before);
  EXPECT_TRUE(mesh::validate(withMirrorImage(half)).closed);
}

}  // namespace
}  // namespace palpate::body
