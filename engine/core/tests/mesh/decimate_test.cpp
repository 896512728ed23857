// Fewer triangles, exactly as many as asked, the same shape and topology.
#include "palpate/mesh/decimate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "palpate/base/error.h"
#include "palpate/mesh/nearest.h"
#include "palpate/mesh/validate.h"
#include "support/mesh_zoo.h"

namespace palpate::mesh {
namespace {

struct Deviation {
  double rms = 0.0;
  double max = 0.0;
};

// From the vertices of one surface to another surface.
Deviation deviation(const TriangleMesh& from, const TriangleMesh& to) {
  const NearestTriangle tree(to);
  Deviation result;
  for (const Vec3& p : from.positions) {
    const double d = tree.find(p).distance;
    result.rms += d * d;
    result.max = std::max(result.max, d);
  }
  result.rms = std::sqrt(result.rms / static_cast<double>(from.positions.size()));
  return result;
}

TEST(Decimate, ReachesEveryEvenCountOnAClosedMesh) {
  const TriangleMesh sphere = zoo::sphere(20.0, 3);
  for (std::size_t target = 40; target <= 1280; target += 62) {
    const TriangleMesh fewer = decimate(sphere, target);
    EXPECT_EQ(fewer.triangles.size(), target);
    EXPECT_EQ(fewer.positions.size(), target / 2 + 2) << "Euler's formula of a sphere";
  }
}

TEST(Decimate, ReachesOddAndEvenCountsOnAnOpenMesh) {
  const TriangleMesh sheet = zoo::wavyGrid(24, 100.0, 5.0);
  for (const std::size_t target : {100u, 101u, 102u, 777u, 1151u}) {
    EXPECT_EQ(decimate(sheet, target).triangles.size(), target);
  }
}

TEST(Decimate, RefusesAnOddCountOnAClosedMesh) { EXPECT_THROW(decimate(zoo::sphere(20.0, 2), 101), Error); }

TEST(Decimate, RefusesToCloseTheHoleOfATorus) { EXPECT_THROW(decimate(zoo::torus(), 4), Error); }

TEST(Decimate, LeavesAMeshThatIsSmallEnoughAlone) {
  const TriangleMesh cube = zoo::cube();
  const TriangleMesh same = decimate(cube, 12);
  EXPECT_EQ(same.triangles, cube.triangles);
  EXPECT_EQ(decimate(cube, 500).triangles, cube.triangles);
}

TEST(Decimate, KeepsClosedManifoldsClosedAndManifold) {
  for (const TriangleMesh& mesh : {zoo::sphere(20.0, 4), zoo::torus(20.0, 6.0, 64, 32), zoo::plate()}) {
    const ValidationReport before = validate(mesh);
    const ValidationReport after = validate(decimate(mesh, std::min<std::size_t>(200, mesh.triangles.size())));
    EXPECT_TRUE(after.closed);
    EXPECT_TRUE(after.fit());
    EXPECT_EQ(after.self_intersections.count, 0u);
    EXPECT_EQ(after.components, before.components);
    EXPECT_NEAR(after.volume_mm3, before.volume_mm3, 0.05 * before.volume_mm3);
  }
}

TEST(Decimate, KeepsATorusATorus) {
  const TriangleMesh fewer = decimate(zoo::torus(20.0, 6.0, 64, 32), 300);
  EXPECT_EQ(fewer.positions.size(), 150u) << "Euler characteristic 0";
}

TEST(Decimate, StaysOnASphere) {
  // 1000 equal triangles inscribed in this sphere sag by 4 A / (3 sqrt 3) / 2 R = 0.097 mm in their middle.
  const Deviation d = deviation(decimate(zoo::sphere(20.0, 5), 1000), zoo::sphere(20.0, 5));
  EXPECT_LT(d.rms, 0.07);
  EXPECT_LT(d.max, 0.15);
}

TEST(Decimate, IsExactOnFlatFacesAndKeepsTheBorder) {
  const TriangleMesh fewer = decimate(zoo::grid(16, 100.0), 60);
  for (const Vec3& p : fewer.positions) EXPECT_NEAR(p.z(), 0.0, 1e-9);
  const auto box = boundingBox(fewer);
  EXPECT_NEAR(box.min().x(), 0.0, 1e-6);
  EXPECT_NEAR(box.max().y(), 100.0, 1e-6);
  EXPECT_NEAR(validate(fewer).area_mm2, 10000.0, 1.0);
}

TEST(Decimate, MirroredHalfKeepsItsPlaneAndJoinsWithoutAChord) {
  TriangleMesh half;  // the sheet from x = 0 on; its other borders are free to move as well but x = 0 must hold
  half = zoo::sphere(20.0, 4);
  // Cut the sphere: the icosphere has vertices on x = 0, triangles never cross it.
  std::erase_if(half.triangles, [&](const Triangle& t) {
    return half.positions[t[0]].x() + half.positions[t[1]].x() + half.positions[t[2]].x() < 0.0;
  });
  for (Vec3& p : half.positions) p.x() = std::abs(p.x()) < 1e-9 ? 0.0 : p.x();
  DecimateOptions options;
  options.mirrored_at_x0 = true;
  const TriangleMesh fewer = decimate(half, 301, options);
  ASSERT_EQ(fewer.triangles.size(), 301u);
  const ValidationReport report = validate(fewer);
  EXPECT_EQ(report.border_loops, 1u);
  std::size_t in_plane = 0;
  for (const Vec3& p : fewer.positions) in_plane += p.x() == 0.0 ? 1 : 0;
  EXPECT_EQ(in_plane, report.border_edges.count) << "the border, and nothing but it, lies in the plane";
}

TEST(Decimate, GivesTheSameMeshTwice) {
  const TriangleMesh sphere = zoo::sphere(20.0, 4);
  const TriangleMesh first = decimate(sphere, 500);
  const TriangleMesh second = decimate(sphere, 500);
  EXPECT_EQ(first.triangles, second.triangles);
  EXPECT_EQ(first.positions, second.positions);
}

}  // namespace
}  // namespace palpate::mesh
