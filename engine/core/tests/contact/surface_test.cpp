#include "palpate/contact/surface.h"

#include <cmath>
#include <string_view>

#include "core/tests/contact/finger_track.h"
#include "palpate/base/error.h"
#include "palpate/base/random.h"
#include "support/mesh_zoo.h"

namespace palpate::contact {

namespace {

std::vector<double> stiffnessFor(const mesh::TriangleMesh& mesh) {
  return std::vector<double>(mesh.positions.size(), kTestStiffness);
}

constexpr double kAnyPath = 1e9;

}  // namespace

TEST(Surface, RefusesAMeshOnWhichAWalkWouldLoseItsWay) {
  for (const auto& mesh : {zoo::cubesSharingAnEdge(), zoo::cubesSharingAVertex(), zoo::mixedWinding()}) {
    EXPECT_THROW(buildSurface(mesh, stiffnessFor(mesh)), Error);
    EXPECT_NO_THROW(surfaceOf(mesh)) << "after repair";
  }
  EXPECT_THROW(buildSurface({}, {}), Error);
}

TEST(Surface, RefusesAStiffnessThatIsNone) {
  const auto mesh = zoo::oneTriangle();
  EXPECT_THROW(buildSurface(mesh, {0.5, 0.5}), Error);
  EXPECT_THROW(buildSurface(mesh, {0.5, 0.5, -1.0}), Error);
  EXPECT_THROW(buildSurface(mesh, {0.5, 0.5, NAN}), Error);
}

TEST(Surface, KnowsWhetherItsSheetsPierceEachOther) {
  EXPECT_TRUE(surfaceOf(zoo::overlappingSpheres()).geometry->self_intersecting);
  EXPECT_FALSE(surfaceOf(zoo::sphere()).geometry->self_intersecting);
  const auto spheres = zoo::overlappingSpheres();
  EXPECT_TRUE(buildSurface(spheres, stiffnessFor(spheres)).geometry->self_intersecting)
      << "looked for when nobody says";
}

TEST(Surface, ItsMakingReportsOnwardsAndEndsWithWhatTheListenerThrows) {
  const mesh::TriangleMesh sheet = zoo::wavyGrid(250, 200.0, 3.0);  // more than one report of each step
  double latest = 0.0;
  int reports = 0;
  const auto listen = [&](std::string_view, double done) {
    EXPECT_GE(done, latest);
    EXPECT_LE(done, 1.0);
    latest = done;
    ++reports;
  };
  const auto heard = buildGeometry(sheet, false, listen);
  EXPECT_GT(reports, 10);
  EXPECT_EQ(heard->vertex_normals, buildGeometry(sheet)->vertex_normals);
  for (int last = 1; last < reports; last += 2) {
    int left = last;
    const auto end = [&](std::string_view, double) {
      if (--left == 0) throw Error("enough");
    };
    EXPECT_THROW(buildGeometry(sheet, false, end), Error) << last;
    EXPECT_EQ(left, 0) << "nothing is reported afterwards";
  }
}

TEST(SurfaceWalk, OnAConvexBodyItEndsAtTheNearestPoint) {
  const Surface surface = surfaceOf(zoo::sphere(20.0, 3));
  Random random(31);
  SurfacePoint place{surface.geometry->tree.records[0].corners[0], 0, tree::Feature::corner0};
  for (int i = 0; i < 500; ++i) {
    const Vec3 target = 25.0 * random.normal3().normalized();
    const WalkResult walk = walkToNearest(surface, place, target, kAnyPath);
    ASSERT_TRUE(walk.finished);
    const double expected = nearestPoint(surface.geometry->tree, target, 1e3).closest.squared_distance;
    EXPECT_NEAR((walk.at.position - target).squaredNorm(), expected, 1e-9);
    place = walk.at;
  }
}

TEST(SurfaceWalk, PausesWhereThePathIsUsedUp) {
  const Surface surface = surfaceOf(zoo::grid(8, 100.0));
  const SurfacePoint start{
      {10, 10, 0}, nearestPoint(surface.geometry->tree, {10, 10, 0}, 1).triangle, tree::Feature::face};
  const WalkResult half = walkToNearest(surface, start, {70, 90, -5}, 40.0);
  EXPECT_FALSE(half.finished);
  EXPECT_LE((half.at.position - start.position).norm(), 40.0 + 1e-9);
  EXPECT_GE((half.at.position - start.position).norm(), 30.0) << "roughly straight on a plane";
  const WalkResult rest = walkToNearest(surface, half.at, {70, 90, -5}, kAnyPath);
  EXPECT_TRUE(rest.finished);
  EXPECT_NEAR((rest.at.position - Vec3(70, 90, 0)).norm(), 0, 1e-9);
}

TEST(SurfaceWalk, VisitsTheWholeFanOfAVertexOnce) {
  const Surface surface = surfaceOf(zoo::grid(4, 40.0));
  std::vector<int> expected(surface.geometry->vertex_normals.size(), 0);
  for (const auto& record : surface.geometry->tree.records) {
    for (const Index v : record.vertices) ++expected[v];
  }
  for (Index t = 0; t < surface.geometry->tree.records.size(); ++t) {
    for (int corner = 0; corner < 3; ++corner) {
      int visits = 0;
      visitFan(surface, t, corner, [&](Index, int) { ++visits; });
      EXPECT_EQ(visits, expected[surface.geometry->tree.records[t].vertices[corner]]);
    }
  }
}

TEST(SurfaceWalk, StiffnessIsBarycentric) {
  const mesh::TriangleMesh mesh = zoo::oneTriangle();
  const Surface surface = buildSurface(mesh, {0.2, 0.5, 0.8});
  const auto& corners = surface.geometry->tree.records[0].corners;
  const Vec3 place = 0.5 * corners[0] + 0.3 * corners[1] + 0.2 * corners[2];
  EXPECT_NEAR(skinAt(surface, {place, 0, tree::Feature::face}).stiffness_n_per_mm, 0.5 * 0.2 + 0.3 * 0.5 + 0.2 * 0.8,
              1e-12);
}

TEST(Surface, KnowsWhetherTheBodyTouchesItself) {
  for (const auto& mesh : {zoo::cube(), zoo::sphere(), zoo::hollowSphere(), zoo::grid(), zoo::overlappingSpheres()})
    EXPECT_FALSE(surfaceOf(mesh).geometry->touches_itself);
  for (const auto& mesh : {zoo::cubesSharingAnEdge(), zoo::cubesSharingAVertex()})
    EXPECT_TRUE(surfaceOf(mesh).geometry->touches_itself);
}

}  // namespace palpate::contact
