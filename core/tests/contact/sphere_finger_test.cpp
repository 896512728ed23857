#include <cmath>

#include "core/tests/contact/finger_track.h"
#include "lab/workloads/workload_meshes.h"
#include "palpate/base/random.h"
#include "support/mesh_zoo.h"

namespace palpate::contact {

namespace {

FingerSettings slick(double radius_mm) {
  FingerSettings settings = sphereOf(radius_mm);
  settings.mu_static = settings.mu_dynamic = 0.0;
  return settings;
}

}  // namespace

TEST(SphereFinger, TouchesAtItsRadius) {
  const Surface plate = surfaceOf(zoo::grid());
  for (const double radius : {0.5, 5.0, 8.0}) {
    FingerTrack finger(plate, sphereOf(radius));
    EXPECT_FALSE(touches(finger.to({51, 49, radius + 1})));
    const FingerOutput output = finger.to({51, 49, radius - 2});
    EXPECT_NEAR(output.depth_mm, 2.0, 1e-4 * radius);
    EXPECT_NEAR((output.proxy - Vec3(51, 49, 0)).norm(), 0, 2e-4 * radius);
    EXPECT_NEAR((output.force - Vec3(0, 0, 2 * kTestStiffness)).norm(), 0, 1e-3);
    EXPECT_FALSE(touches(finger.to({51, 49, radius + 1e-6})));
  }
}

TEST(SphereFinger, RestsBetweenTheWallsOfAGroove) {
  for (const double angle_deg : {60.0, 90.0, 120.0}) {
    const Surface groove = surfaceOf(lab::grooveMesh(angle_deg));
    const double radius = 8.0;
    FingerTrack finger(groove, slick(radius));
    finger.to({100, 50, 80});
    const FingerOutput output = finger.slide({100, 50, -5}, 0.5);
    const double rest = radius / std::sin(angle_deg * M_PI / 360.0);  // height of the centre over the bottom
    EXPECT_NEAR((finger.state().centre - Vec3(100, 50, rest)).norm(), 0, 1e-3 * radius) << angle_deg;
    EXPECT_NEAR(output.depth_mm, rest + 5, 1e-3 * radius);
  }
}

TEST(SphereFinger, CrossesAGrooveNarrowerThanItselfWithoutAStep) {
  const Surface groove = surfaceOf(lab::grooveMesh(60.0));
  FingerTrack finger(groove, slick(8.0));
  finger.to({90, 50, 80});
  finger.slide({90, 50, -5}, 0.5);
  FingerOutput last = finger.to({90, 50, -5});
  for (double x = 90; x <= 110; x += 0.1) {
    const FingerOutput now = finger.to({x, 50, -5});
    EXPECT_LE((now.force - last.force).norm(), 2.0 * kTestStiffness * 0.1);
    last = now;
  }
}

TEST(SphereFinger, RollsOverACubesEdgeAndCorner) {
  const Surface box = surfaceOf(zoo::cube(100.0, {0, 0, 0}));
  FingerTrack finger(box, slick(8.0));
  finger.to({50, 50, 120});
  finger.slide({50, 50, 103}, 0.5);
  for (const Vec3& goal : {Vec3(100, 50, 103), Vec3(103, 50, 100), Vec3(103, 50, 50), Vec3(102, 102, 102)}) {
    finger.slide(goal, 0.3);
    const Vec3& centre = finger.state().centre;
    const Vec3 outside = (centre - Vec3(50, 50, 50)).cwiseAbs() - Vec3(50, 50, 50);
    EXPECT_NEAR(outside.cwiseMax(0.0).norm(), 8.0, 0.01) << goal.transpose();
  }
}

TEST(SphereFinger, NeverSinksInNorHangsInAWalkOverHills) {
  const Surface hills = surfaceOf(zoo::wavyGrid(60, 120.0, 6.0));
  for (const double radius : {0.5, 5.0, 8.0}) {
    FingerTrack finger(hills, sphereOf(radius));
    Random random(51);
    Vec3 tip(60, 60, 30);
    finger.to(tip);
    for (int i = 0; i < 4000; ++i) {
      const Vec3 goal(60 + 35 * std::sin(0.0011 * i), 60 + 35 * std::sin(0.0017 * i), radius - 6);
      tip += 0.01 * (goal - tip) + 0.02 * random.normal3();
      const FingerOutput output = finger.to(tip);
      if (!touches(output)) continue;
      const auto nearest = nearestPoint(hills.geometry->tree, finger.state().centre, 3 * radius);
      ASSERT_NE(nearest.triangle, kNoIndex) << "the sphere left the skin at tick " << i;
      ASSERT_GE(std::sqrt(nearest.closest.squared_distance), 0.999 * radius) << "tick " << i;
      ASSERT_LE(output.depth_mm, 25.0);
    }
  }
}

TEST(SphereFinger, OneThatStartsInTheSkinIsPushedOutGently) {
  const Surface plate = surfaceOf(zoo::grid());
  FingerTrack finger(plate, sphereOf(8.0));
  FingerOutput last = finger.to({50, 50, 5});
  EXPECT_TRUE(touches(last)) << "in its first tick";
  EXPECT_NE(last.status & kStartedInside, 0u);
  for (int i = 0; i < 40; ++i) {
    const FingerOutput now = finger.to({50, 50, 5});
    EXPECT_LE((now.force - last.force).norm(), 0.0501) << "0.1 mm a tick";
    last = now;
  }
  EXPECT_NEAR(last.depth_mm, 3.0, 1e-3);
  EXPECT_EQ(last.status & kStartedInside, 0u);
}

TEST(SphereFinger, OneThatStartsInsideABodyIsFreeUntilItHasBeenOutside) {
  const Surface box = surfaceOf(zoo::cube(100.0, {0, 0, 0}));
  FingerTrack finger(box, sphereOf(8.0));
  EXPECT_FALSE(touches(finger.to({50, 50, 50})));
  EXPECT_FALSE(touches(finger.slide({50, 50, 99}, 0.5)));
  EXPECT_TRUE(touches(finger.slide({50, 50, 101}, 0.5)));
}

TEST(SphereFinger, FadesAtTheBorderAndComesBackUnderTheSheetFreely) {
  const Surface plate = surfaceOf(zoo::grid(8, 100.0));
  FingerTrack finger(plate, slick(8.0));
  finger.to({90, 50, 12});
  finger.slide({90, 50, 4}, 0.5);
  FingerOutput last = finger.to({90, 50, 4});
  for (double x = 90.1; x <= 106; x += 0.1) {
    const FingerOutput now = finger.to({x, 50, 4});
    EXPECT_LE((now.force - last.force).norm(), 0.06);
    last = now;
  }
  EXPECT_FALSE(touches(last));
  finger.slide({112, 50, -20}, 0.5);
  EXPECT_FALSE(touches(finger.slide({50, 50, -20}, 0.5)));
  EXPECT_FALSE(touches(finger.slide({50, 50, -2}, 0.5))) << "seen from behind the sheet is not felt";
}

TEST(SphereFinger, PressedNearABorderItDoesNotSlipUnderTheSheet) {
  const Surface plate = surfaceOf(zoo::grid(8, 100.0));
  FingerTrack finger(plate, sphereOf(8.0));
  finger.to({97, 50, 12});
  const FingerOutput output = finger.slide({97, 50, -15}, 0.5);
  EXPECT_TRUE(touches(output));
  EXPECT_NEAR(output.depth_mm, 23.0, 0.01);
}

TEST(SphereFinger, IsNeverThrownToTheFarSideOfABody) {
  const Surface box = surfaceOf(zoo::cube(100.0, {0, 0, 0}));
  FingerTrack finger(box, sphereOf(8.0));
  finger.to({50, 60, 120});
  FingerOutput output = finger.slide({50, 60, 1}, 1.0);  // 99 mm below the top, 1 above the bottom
  EXPECT_NEAR(finger.state().centre.z(), 108.0, 0.01);
  EXPECT_NEAR(output.force.z(), 48.0 * kTestStiffness, 1e-9) << "the deepest that is felt, and the radius";
  finger.slide({50, 60, -20}, 0.1);  // out of the bottom
  for (int i = 0; i < 500; ++i) output = finger.to({50, 60, -20});
  EXPECT_FALSE(touches(output));
  EXPECT_NEAR(finger.to({50, 60, -5}).force.z(), -3 * kTestStiffness, 1e-6);
}

TEST(SphereFinger, IsNotHeldInFreeAirByAnEdgeThatTwoBoxesShare) {
  mesh::TriangleMesh boxes = zoo::cubesSharingAnEdge();
  for (Vec3& place : boxes.positions) place *= 5.0;
  const Surface surface = surfaceOf(boxes);
  FingerTrack finger(surface, sphereOf(5.0));
  expectLetGoInTheOtherSector(finger, 6.0);
}

TEST(SphereFinger, IsLetGoWhereItsCentreIsPastAGapAndInFreeAir) {
  // Two bars with 6 mm between them, 10 mm thick.
  mesh::TriangleMesh bars = zoo::cube(10.0, {-13, 0, 0});
  mesh::append(zoo::cube(10.0, {3, 0, 0}), bars);
  const Surface surface = surfaceOf(bars);
  FingerTrack finger(surface, sphereOf(5.0));
  finger.to({0.1, 5, 20});
  FingerOutput output = finger.slide({0.1, 5, -4.0}, 0.1);  // 4 mm below the bars: not clear yet
  EXPECT_GT(output.force.z(), 5.0) << "it does not fit through";
  finger.slide({0.1, 5, -6.0}, 0.1);
  for (int i = 0; i < 500; ++i) output = finger.to({0.1, 5, -6.0});
  EXPECT_FALSE(touches(output)) << output.force.norm() << " N";
}

TEST(SphereFinger, ALostTipGivesNoForceAndForgetsNothing) {
  const Surface plate = surfaceOf(zoo::grid());
  FingerTrack finger(plate, sphereOf(5.0));
  finger.to({50, 50, 9});
  finger.slide({50, 50, 2}, 0.5);
  const FingerOutput before = finger.to({50, 50, 2});
  EXPECT_EQ(finger.to({50, NAN, 2}).force, Vec3(0, 0, 0));
  EXPECT_NEAR((finger.to({50, 50, 2}).force - before.force).norm(), 0, 1e-9);
}

TEST(SphereFinger, AVerySmallSphereFeelsLikeAPoint) {
  const Surface back = surfaceOf(lab::backMesh(2962));
  FingerTrack point(back), sphere(back, sphereOf(0.001));
  Vec3 tip(175, 200, lab::backHeight(175, 200) + 3);
  point.to(tip);
  sphere.to(tip);
  int alike = 0;
  for (int i = 0; i < 2000; ++i) {
    const double x = 175 + 60 * std::sin(0.003 * i), y = 200 + 40 * std::sin(0.002 * i);
    tip = {x, y, lab::backHeight(x, y) + std::max(-4.0, 3.0 - 0.02 * i)};
    const FingerOutput p = point.to(tip), s = sphere.to(tip);
    // Where a facet lets the proxy go, the two may be some ticks apart.
    alike += (p.force - s.force).norm() <= 0.02 ? 1 : 0;
    EXPECT_NEAR((p.force - s.force).norm(), 0, 0.5) << "tick " << i;
  }
  EXPECT_GE(alike, 1900);
}

}  // namespace palpate::contact
