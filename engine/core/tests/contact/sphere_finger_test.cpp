#include <cmath>
#include <numbers>

#include "core/tests/contact/finger_track.h"
#include "lab/workloads/workload_meshes.h"
#include "palpate/base/random.h"
#include "support/mesh_zoo.h"

namespace palpate::contact {

namespace {

FingerSettings slick(double radius_mm) {
  FingerSettings settings = sphereSettings(radius_mm);
  settings.mu_static = settings.mu_dynamic = 0.0;
  return settings;
}

/// A palm from x = 0 to 40 with fingers to x = 100, 20 mm thick; `sides` are the two sides in y of each finger in turn.
/// The wrist at x = 0 is closed or cut.
mesh::TriangleMesh handOf(const std::vector<double>& sides, bool is_cut) {
  mesh::TriangleMesh mesh;
  const auto add_face = [&](const Vec3& corner, const Vec3& u, const Vec3& v) {  // seen from u x v
    const auto first = static_cast<Index>(mesh.positions.size());
    for (const Vec3& p : {corner, Vec3(corner + u), Vec3(corner + u + v), Vec3(corner + v)})
      mesh.positions.push_back(p);
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  };
  const Vec3 up(0, 0, 20);
  for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
    const bool is_finger = i % 2 == 0;
    const Vec3 wide(0, sides[i + 1] - sides[i], 0);
    const auto add_slab = [&](double from, double to) {
      const Vec3 corner(from, sides[i], 0), along(to - from, 0, 0);
      add_face(corner + up, along, wide);
      add_face(corner, wide, along);
    };
    add_slab(0, 40);
    if (is_finger) add_slab(40, 100);
    if (!is_cut) add_face({0, sides[i], 0}, up, wide);
    add_face({is_finger ? 100.0 : 40.0, sides[i], 0}, wide, up);
  }
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const bool begins = i % 2 == 0;
    const double from = i == 0 || i + 1 == sides.size() ? 0.0 : 40.0;
    const auto add_wall = [&](double x, double length) {
      const Vec3 corner(x, sides[i], 0), along(length, 0, 0);
      begins ? add_face(corner, along, up) : add_face(corner, up, along);
    };
    add_wall(40, 60);
    if (from == 0.0) add_wall(0, 40);
  }
  return mesh;
}

/// Presses an 8 mm finger through every gap of the closed and of the cut hand and out below: the cut, 80 mm away,
/// changes nothing.
void expectTheSameOfACutHand(const std::vector<double>& sides) {
  const Surface whole = surfaceOf(handOf(sides, false)), cut = surfaceOf(handOf(sides, true));
  ASSERT_TRUE(whole.geometry->closed);
  ASSERT_FALSE(cut.geometry->closed);
  for (std::size_t gap = 1; gap + 2 < sides.size(); gap += 2) {
    const double y = 0.5 * (sides[gap] + sides[gap + 1]) + 0.1;
    FingerTrack of_whole(whole, sphereSettings(8.0)), of_cut(cut, sphereSettings(8.0));
    double most = 0.0, below = 0.0;
    for (int tick = 0; tick < 400; ++tick) {
      const Vec3 tip(80, y, 31 - 0.15 * tick);
      const FingerOutput output = of_cut.to(tip);
      EXPECT_EQ(output.force, of_whole.to(tip).force) << tip.transpose();
      most = std::max(most, output.force.norm());
      if (tip.z() < -25.0) below = std::max(below, output.force.norm());
    }
    EXPECT_GT(most, 5.0) << "it does not fit through";
    EXPECT_EQ(below, 0.0) << "N in free air, after what was felt has faded";
  }
}

/// A knobbly horn of eight sides, bent over 4.5 radian, whose end is cut off.
mesh::TriangleMesh openHorn() {
  constexpr Index kSides = 8, kRings = 9;
  constexpr double kBend = 4.5, kBendMm = 160.0 / kBend;
  mesh::TriangleMesh horn;
  for (Index ring = 0; ring <= kRings; ++ring) {
    const double angle = kBend * ring / kRings;
    const Vec3 out(-std::sin(angle), 0, std::cos(angle));
    const Vec3 middle = kBendMm * (Vec3::UnitZ() - out);
    for (Index side = 0; side < kSides; ++side) {
      const double around = 2.0 * std::numbers::pi * side / kSides;
      const double radius = 12.0 * (1.0 + 0.3 * std::sin(1.3 * ring + side));
      horn.positions.push_back(middle + radius * (std::cos(around) * out + std::sin(around) * Vec3::UnitY()));
    }
  }
  const auto tip = static_cast<Index>(horn.positions.size());
  horn.positions.push_back(Vec3::Zero());
  for (Index side = 0; side < kSides; ++side) {
    const Index next = (side + 1) % kSides;
    horn.triangles.push_back({tip, side, next});
    for (Index ring = 0; ring < kRings; ++ring) {
      const Index a = ring * kSides + side, b = ring * kSides + next;
      horn.triangles.push_back({a, a + kSides, b + kSides});
      horn.triangles.push_back({a, b + kSides, b});
    }
  }
  return horn;
}

}  // namespace

TEST(SphereFinger, TouchesAtItsRadius) {
  const Surface plate = surfaceOf(zoo::grid());
  for (const double radius : {0.5, 5.0, 8.0}) {
    FingerTrack finger(plate, sphereSettings(radius));
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
    FingerTrack finger(hills, sphereSettings(radius));
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
  FingerTrack finger(plate, sphereSettings(8.0));
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
  FingerTrack finger(box, sphereSettings(8.0));
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
  FingerTrack finger(plate, sphereSettings(8.0));
  finger.to({97, 50, 12});
  const FingerOutput output = finger.slide({97, 50, -15}, 0.5);
  EXPECT_TRUE(touches(output));
  EXPECT_NEAR(output.depth_mm, 23.0, 0.01);
}

TEST(SphereFinger, IsNeverThrownToTheFarSideOfABody) {
  const Surface box = surfaceOf(zoo::cube(100.0, {0, 0, 0}));
  FingerTrack finger(box, sphereSettings(8.0));
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
  FingerTrack finger(surface, sphereSettings(5.0));
  expectLetGoInTheOtherSector(finger, 6.0);
}

TEST(SphereFinger, IsLetGoWhereItsCentreIsPastAGapAndInFreeAir) {
  // Two bars with 6 mm between them, 10 mm thick.
  mesh::TriangleMesh bars = zoo::cube(10.0, {-13, 0, 0});
  mesh::append(zoo::cube(10.0, {3, 0, 0}), bars);
  const Surface surface = surfaceOf(bars);
  FingerTrack finger(surface, sphereSettings(5.0));
  finger.to({0.1, 5, 20});
  FingerOutput output = finger.slide({0.1, 5, -4.0}, 0.1);  // 4 mm below the bars: not clear yet
  EXPECT_GT(output.force.z(), 5.0) << "it does not fit through";
  finger.slide({0.1, 5, -6.0}, 0.1);
  for (int i = 0; i < 500; ++i) output = finger.to({0.1, 5, -6.0});
  EXPECT_FALSE(touches(output)) << output.force.norm() << " N";
}

TEST(SphereFinger, IsLetGoBelowASlotOfABodyThatIsOpenFarAway) { expectTheSameOfACutHand({0, 27, 33, 60}); }

TEST(SphereFinger, IsLetGoBetweenTheFingersOfAHandThatIsOpenAtTheWrist) {
  expectTheSameOfACutHand({0, 16, 24, 41, 51, 66, 72, 85});
}

TEST(SphereFinger, IsLetGoFarBeyondABorderThatItSlidOver) {
  // 52 mm below a sheet of 100 x 100 mm, continued flat, the force would fade until 60 mm beyond its border.
  const Surface sheet = surfaceOf(zoo::grid());
  FingerSettings deep = sphereSettings(8.0);
  deep.max_depth_mm = 100.0;
  FingerTrack finger(sheet, deep);
  finger.to({90, 50, 9});
  finger.slide({95, 50, -52}, 0.5);
  EXPECT_GT(finger.slide({130, 50, -52}, 0.5).force.z(), 10.0);
  finger.slide({152, 50, -52}, 0.5);
  FingerOutput output;
  for (int i = 0; i < 300; ++i) output = finger.to({152, 50, -52});
  EXPECT_FALSE(touches(output)) << output.force.norm() << " N";
}

TEST(SphereFinger, ThatGoesOverAHoleIsHeldByTheSkinOfTheOtherBank) {
  // A sheet of 100 x 100 mm with a hole of 20 mm across it.
  mesh::TriangleMesh sheet = zoo::grid(20);
  std::erase_if(sheet.triangles, [&](const Triangle& t) {
    const Vec3 middle = mesh::centreOf(sheet, t);
    return std::abs(middle.x() - 50.0) < 10.0 && std::abs(middle.y() - 50.0) < 10.0;
  });
  const Surface surface = surfaceOf(sheet);
  ASSERT_FALSE(surface.geometry->closed);
  FingerTrack finger(surface, sphereSettings(5.0));
  finger.to({30, 50, 8});
  finger.slide({30, 50, -32}, 0.5);
  EXPECT_LT(finger.slide({58, 50, -32}, 0.5).force.z(), 12.0) << "beyond the border it fades";
  FingerOutput output = finger.slide({75, 50, -32}, 0.5);
  for (int i = 0; i < 100; ++i) output = finger.to({75, 50, -32});
  ASSERT_TRUE(touches(output));
  EXPECT_NEAR(output.force.z(), 37.0 * kTestStiffness, 0.1);
}

TEST(SphereFinger, BeyondABorderItFadesWhereverAPointWouldPress) {
  const Surface horn = surfaceOf(openHorn());
  ASSERT_FALSE(horn.geometry->closed);
  FingerTrack finger(horn, sphereSettings(5.0));
  finger.to({-1, 25, 47});
  finger.to({-27, 15, 59});
  const FingerOutput output = finger.to({-35, -7, 40});
  ASSERT_TRUE(touches(output));
  const Vec3 centre = output.proxy + 5.0 * output.normal;
  EXPECT_GT((nearestPoint(horn.geometry->tree, centre, kUnbounded).closest.point - centre).norm(), 6.0);
  EXPECT_NE(output.status & kAtBorder, 0u);
  EXPECT_LT(output.force.norm(), 0.9 * kTestStiffness * output.depth_mm);
}

TEST(SphereFinger, APointThatCameInByAnOpeningIsFreeInsideAfterItTouchedWhatIsThere) {
  // A box that is open at one end, with a smaller one in it: as an organ in a trunk.
  mesh::TriangleMesh trunk = handOf({0, 60}, true);
  for (Vec3& p : trunk.positions) p.z() *= 3.0;
  mesh::append(zoo::cube(10.0, {60, 25, 25}), trunk);
  const Surface surface = surfaceOf(trunk);
  ASSERT_FALSE(surface.geometry->closed);
  FingerTrack finger(surface);
  finger.to({-20, 30, 30});
  EXPECT_FALSE(touches(finger.slide({59, 30, 30}, 0.5)));
  EXPECT_NEAR(finger.slide({62, 30, 30}, 0.5).force.x(), -2.0 * kTestStiffness, 1e-9);
  finger.slide({55, 30, 30}, 0.5);
  FingerOutput output;
  for (int i = 0; i < 100; ++i) output = finger.to({55, 30, 30});
  EXPECT_FALSE(touches(output)) << output.force.norm() << " N";
}

TEST(SphereFinger, ALostTipGivesNoForceAndForgetsNothing) {
  const Surface plate = surfaceOf(zoo::grid());
  FingerTrack finger(plate, sphereSettings(5.0));
  finger.to({50, 50, 9});
  finger.slide({50, 50, 2}, 0.5);
  const FingerOutput before = finger.to({50, 50, 2});
  EXPECT_EQ(finger.to({50, NAN, 2}).force, Vec3(0, 0, 0));
  EXPECT_NEAR((finger.to({50, 50, 2}).force - before.force).norm(), 0, 1e-9);
}

TEST(SphereFinger, AVerySmallSphereFeelsLikeAPoint) {
  const Surface back = surfaceOf(lab::backMesh(2962));
  FingerTrack point(back), sphere(back, sphereSettings(0.001));
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
