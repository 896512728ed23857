#include <cmath>
#include <limits>

#include "core/tests/contact/finger_track.h"
#include "palpate/base/error.h"
#include "palpate/base/random.h"
#include "support/mesh_zoo.h"

namespace palpate::contact {

TEST(PointFinger, FeelsNothingAbove) {
  const Surface plate = surfaceOf(zoo::grid());
  FingerTrack finger(plate);
  const FingerOutput output = finger.to({50, 50, 3});
  EXPECT_FALSE(touches(output));
  EXPECT_EQ(output.force, Vec3(0, 0, 0));
  EXPECT_EQ(output.proxy, output.tip);
  EXPECT_EQ(output.triangle, kNoIndex);
}

TEST(PointFinger, FirstContactHasItsForceInTheSameTick) {
  const Surface plate = surfaceOf(zoo::grid());
  FingerTrack finger(plate);
  finger.to({51.3, 48.7, 5});
  const FingerOutput output = finger.to({51.3, 48.7, -4});
  EXPECT_NEAR((output.force - Vec3(0, 0, 4 * kTestStiffness)).norm(), 0, 1e-12);
  EXPECT_NEAR((output.proxy - Vec3(51.3, 48.7, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR(output.depth_mm, 4.0, 1e-12);
  EXPECT_EQ(output.touch, Touch::stick);
}

TEST(PointFinger, EntersThroughVerticesAndEdgesAndAfterAStopOnTheSurface) {
  const Surface plate = surfaceOf(zoo::grid(8, 100.0));
  expectEntranceEverywhere<FingerTrack>(plate);
}

TEST(PointFinger, ComesInFromTheFrontOnly) {
  const Surface plate = surfaceOf(zoo::grid());
  FingerTrack finger(plate);
  finger.to({50, 50, -5});
  EXPECT_FALSE(touches(finger.to({50, 50, 5}))) << "from behind";
  EXPECT_TRUE(touches(finger.to({50, 50, -5}))) << "and back";
}

TEST(PointFinger, LetsGoInFrontAndFeelsAgain) {
  const Surface plate = surfaceOf(zoo::grid());
  FingerTrack finger(plate);
  for (int press = 0; press < 3; ++press) {
    finger.to({50, 50, 2});
    EXPECT_TRUE(touches(finger.to({50, 50, -2})));
    EXPECT_TRUE(touches(finger.to({50, 50, 0}))) << "on the plane it still touches";
    EXPECT_FALSE(touches(finger.to({50, 50, 1e-9})));
  }
}

TEST(PointFinger, PressesAcrossAConcaveEdgeWithoutASkip) {
  // A trough of 90 degrees along y: the force turns continuously while the tip crosses the bottom.
  mesh::TriangleMesh trough{{{-50, 0, 50}, {-50, 100, 50}, {0, 0, 0}, {0, 100, 0}, {50, 0, 50}, {50, 100, 50}},
                            {{0, 2, 1}, {1, 2, 3}, {2, 4, 3}, {3, 4, 5}}};
  const Surface surface = surfaceOf(trough);
  FingerSettings frictionless;
  frictionless.mu_static = frictionless.mu_dynamic = 0.0;
  FingerTrack finger(surface, frictionless);
  finger.to({-20, 50, 40});
  FingerOutput last = finger.to({-20, 50, 10});
  for (double x = -20; x <= 20; x += 0.1) {
    const FingerOutput now = finger.to({x, 50, -std::abs(x) / 2 - 5});
    ASSERT_TRUE(touches(now));
    EXPECT_LE((now.force - last.force).norm(), 0.5 * ((now.tip - last.tip).norm() * 2 + 0.2));
    last = now;
  }
}

TEST(PointFinger, FadesAtTheBorderAndStaysFreeBelowTheSheet) {
  const Surface plate = surfaceOf(zoo::grid(8, 100.0));
  FingerSettings frictionless;
  frictionless.mu_static = frictionless.mu_dynamic = 0.0;
  FingerTrack finger(plate, frictionless);
  finger.to({90, 50, 5});
  FingerOutput last = finger.to({90, 50, -5});
  for (double x = 90.1; x <= 105.5; x += 0.1) {
    const FingerOutput now = finger.to({x, 50, -5});
    EXPECT_LE((now.force - last.force).norm(), 0.051) << "0.1 mm at 0.5 N/mm";
    EXPECT_NEAR(now.force.z(), kTestStiffness * std::clamp(105.0 - x, 0.0, 5.0), 1e-9);
    last = now;
  }
  EXPECT_FALSE(touches(last));
  EXPECT_FALSE(touches(finger.slide({50, 50, -5}, 0.5))) << "back below the sheet";
  EXPECT_FALSE(touches(finger.slide({50, 50, 5}, 0.5))) << "and out through its back";
}

TEST(PointFinger, FadesRoundACornerOfTheBorder) {
  const Surface plate = surfaceOf(zoo::grid(8, 100.0));
  FingerTrack finger(plate);
  finger.to({97, 97, 5});
  finger.to({97, 97, -5});
  FingerOutput last = finger.to({99.9, 99.9, -5});
  for (double beyond = 0.0; beyond <= 6.0; beyond += 0.1) {
    const FingerOutput now = finger.to({100 + beyond, 100 + beyond, -5});
    EXPECT_LE((now.force - last.force).norm(), 0.12);
    last = now;
  }
  EXPECT_FALSE(touches(last));
}

TEST(PointFinger, AThinPlateHoldsUntilTheTipIsFarTooDeepAndThenLetsGoSoftly) {
  const Surface plate = surfaceOf(zoo::plate(200.0, 2.0));
  const double top = 2.0;
  FingerTrack finger(plate);
  finger.to({100, 100, top + 5});
  for (double depth = 0.5; depth < 40.0; depth += 0.5) {
    const FingerOutput output = finger.to({100, 100, top - depth});
    ASSERT_TRUE(touches(output)) << depth;
    EXPECT_NEAR(output.force.z(), kTestStiffness * depth, 1e-9);
  }
  const FingerOutput let_go = finger.to({100, 100, top - 41});
  EXPECT_NE(let_go.status & kLettingGo, 0u) << "outside on the other side";
  EXPECT_GT(let_go.force.z(), 0.85 * kTestStiffness * 40.0);
  int ticks = 0;
  while (touches(finger.to({100, 100, top - 41})) && ticks < 1000) ++ticks;
  EXPECT_NEAR(ticks, 388, 2) << "0.1 mm a tick, less what is left for friction";
  finger.to({100, 100, -1});
  EXPECT_NEAR(finger.to({100, 100, 1}).force.z(), -kTestStiffness, 1e-9) << "and is felt from below";
}

TEST(PointFinger, ATipThatIsLetGoAndEntersElsewhereIsHeldThere) {
  const Surface plate = surfaceOf(zoo::plate(200.0, 2.0));
  FingerTrack finger(plate);
  finger.to({100, 100, 7});
  finger.slide({100, 100, -39}, 0.5);
  FingerOutput output = finger.slide({100, 100, 1}, 0.5);  // back and into the plate from below, the force still fading
  EXPECT_TRUE(touches(output));
  for (int i = 0; i < 500; ++i) output = finger.to({100, 100, 1});
  EXPECT_NEAR(output.force.z(), -kTestStiffness, 1e-9);
}

TEST(PointFinger, InAFoldEachSheetKeepsItsOwnProxy) {
  // Two sheets that touch, back to back nowhere: the upper faces up, the lower faces up too, 1 mm below.
  mesh::TriangleMesh sheets = zoo::grid(4, 100.0);
  mesh::TriangleMesh lower = sheets;
  for (Vec3& p : lower.positions) p -= Vec3(0, 0, 1);
  append(lower, sheets);
  const Surface surface = surfaceOf(sheets);
  FingerTrack finger(surface);
  finger.to({51, 52, 3});
  const FingerOutput output = finger.to({51, 52, -3});
  EXPECT_NEAR(output.depth_mm, 3.0, 1e-12) << "the first sheet on the way holds";
  finger.slide({60, 60, -3}, 0.3);
  EXPECT_NEAR(finger.state().proxy.position.z(), 0.0, 1e-12);
}

TEST(PointFinger, LandsOnTheNextSheetInTheTickInWhichItLeavesTheFirst) {
  // A floor and a wall that do not share vertices: sliding off the wall's slope onto the floor in one tick.
  mesh::TriangleMesh mesh = zoo::grid(4, 100.0);
  const auto first = static_cast<Index>(mesh.positions.size());
  for (const Vec3& p : {Vec3(40, 0, 30), Vec3(40, 100, 30), Vec3(60, 0, 10), Vec3(60, 100, 10)}) {
    mesh.positions.push_back(p);
  }
  mesh.triangles.push_back({first, first + 2, first + 1});
  mesh.triangles.push_back({first + 1, first + 2, first + 3});
  const Surface surface = surfaceOf(mesh);
  FingerTrack finger(surface);
  finger.to({50, 50, 40});
  ASSERT_TRUE(touches(finger.to({50, 50, 19})));
  const FingerOutput output = finger.to({85, 50, -2});  // in front of the slope's plane, but through the floor
  EXPECT_TRUE(touches(output));
  EXPECT_NEAR(output.proxy.z(), 0.0, 1e-12);
}

TEST(PointFinger, IsNeverThrownToTheFarSideOfABody) {
  const Surface box = surfaceOf(zoo::cube(100.0, {0, 0, 0}));
  FingerTrack finger(box);
  finger.to({50, 60, 110});
  for (double z = 109; z >= 1; --z) {  // 99 mm below the top, 1 above the bottom
    const FingerOutput output = finger.to({50, 60, z});
    const double depth = std::max(0.0, 100.0 - z);
    ASSERT_NEAR(output.force.z(), kTestStiffness * std::min(depth, 40.0), 1e-9) << z;
    ASSERT_EQ((output.status & kTooDeep) != 0, depth > 40.0) << z;
  }
  FingerOutput output = finger.to({50, 60, -1});  // out of the bottom
  EXPECT_NE(output.status & kLettingGo, 0u);
  for (int i = 0; i < 500; ++i) output = finger.to({50, 60, -1});
  EXPECT_FALSE(touches(output));
  EXPECT_NEAR(finger.to({50, 60, 2}).force.z(), -2 * kTestStiffness, 1e-9);
}

TEST(PointFinger, IsNotHeldInFreeAirByAnEdgeThatTwoBoxesShare) {
  mesh::TriangleMesh boxes = zoo::cubesSharingAnEdge();
  for (Vec3& place : boxes.positions) place *= 5.0;
  const Surface surface = surfaceOf(boxes);
  EXPECT_TRUE(surface.geometry->touches_itself);
  FingerTrack finger(surface);
  expectLetGoInTheOtherSector(finger, 1.0);
}

TEST(PointFinger, IsHeldByAnEdgeThatTwoBoxesShareWhileItIsInside) {
  mesh::TriangleMesh boxes = zoo::cubesSharingAnEdge();
  for (Vec3& place : boxes.positions) place *= 5.0;
  const Surface surface = surfaceOf(boxes);
  FingerTrack finger(surface);
  finger.to({30, 70, 25});
  finger.slide({30, 45, 25}, 0.25);
  EXPECT_NEAR(finger.slide({49.9, 40, 25}, 0.25).depth_mm, 10.0, 0.1);
}

TEST(PointFinger, FeelsRepairedNonManifoldAndOneSidedMeshes) {
  for (const auto& mesh : {zoo::cubesSharingAnEdge(), zoo::book(), zoo::moebius(), zoo::cubeWithFin(),
                           zoo::plateWithFoldedSliver(), zoo::cubeWithNeedles(), zoo::cubeWithCap()}) {
    const Surface surface = surfaceOf(mesh);
    Random random(41);
    int felt = 0;
    for (int i = 0; i < 300; ++i) {
      const Index t = static_cast<Index>(random.below(surface.geometry->tree.records.size()));
      const auto& c = surface.geometry->tree.records[t].corners;
      const Vec3 normal = (c[1] - c[0]).cross(c[2] - c[0]).normalized();
      const Vec3 aim = (c[0] + c[1] + c[2]) / 3.0;
      FingerTrack finger(surface);
      finger.to(aim + 0.05 * normal);
      felt += touches(finger.to(aim - 0.05 * normal)) ? 1 : 0;
    }
    EXPECT_EQ(felt, 300);
  }
}

TEST(PointFinger, ALostTipGivesNoForceAndForgetsNothing) {
  const Surface plate = surfaceOf(zoo::grid());
  FingerTrack finger(plate);
  finger.to({50, 50, 5});
  const FingerOutput before = finger.to({50, 50, -3});
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), 1e300, -1e12}) {
    const FingerOutput lost = finger.to({50, bad, -3});
    EXPECT_EQ(lost.force, Vec3(0, 0, 0));
    EXPECT_NE(lost.status & kTipLost, 0u);
    EXPECT_TRUE(lost.tip.allFinite() && lost.proxy.allFinite() && lost.anchor.allFinite());
  }
  EXPECT_EQ(finger.to({50, 50, -3}).force, before.force);
}

TEST(PointFinger, IsNotLostFarAwayFromTheBody) {
  const Surface plate = surfaceOf(zoo::grid());
  FingerTrack finger(plate);
  const FingerOutput far = finger.to({50, 50, 1e6});
  EXPECT_EQ(far.status & kTipLost, 0u);
  EXPECT_EQ(far.proxy, far.tip);
}

TEST(PointFinger, IsLostFromTheVeryFirstTickToo) {
  const Surface plate = surfaceOf(zoo::grid());
  FingerTrack finger(plate);
  EXPECT_NE(finger.to({NAN, 0, 0}).status & kTipLost, 0u);
  finger.to({50, 50, 3});
  EXPECT_TRUE(touches(finger.to({50, 50, -3})));
}

TEST(PointFinger, StartedInsideIsFreeUntilItHasBeenOutside) {
  const Surface box = surfaceOf(zoo::cube(100.0, {0, 0, 0}));
  FingerTrack finger(box);
  EXPECT_FALSE(touches(finger.to({50, 50, 50})));
  EXPECT_FALSE(touches(finger.slide({50, 50, 99}, 1.0)));
  EXPECT_FALSE(touches(finger.slide({50, 50, 103}, 1.0)));
  EXPECT_TRUE(touches(finger.slide({50, 50, 97}, 1.0)));
}

TEST(PointFinger, SlidesOverTwoSpheresThatPierceEachOther) {
  // Over the top from one sphere to the other, 3 mm deep: the tip must not get free inside the second one.
  const Surface spheres = surfaceOf(zoo::overlappingSpheres(4));
  ASSERT_TRUE(spheres.geometry->self_intersecting);
  const auto height = [](double x) { return std::sqrt(std::max(0.0, 400.0 - std::pow(std::abs(x) - 12.5, 2))); };
  const bool centred = std::abs(spheres.geometry->tree.center.x()) < 1.0;
  const double shift = centred ? 0.0 : spheres.geometry->tree.center.x();
  FingerTrack finger(spheres);
  finger.to({shift - 20, 3, 30});
  int ticks = 0, held = 0;
  for (int pass = 0; pass < 4; ++pass) {
    for (double s = -20; s <= 20; s += 0.2) {
      const double x = pass % 2 == 0 ? s : -s;
      held += touches(finger.to({shift + x, 3, height(x) - 3.2})) ? 1 : 0;
      ++ticks;
    }
  }
  EXPECT_GE(held, ticks * 97 / 100);
}

TEST(StepAll, GivesEveryFingerTheBitsOfItsOwnStep) {
  const Surface plate = surfaceOf(zoo::wavyGrid(20, 100.0, 3.0));
  std::vector<FingerSettings> settings(6);
  for (std::size_t i = 0; i < settings.size(); ++i)
    settings[i].radius_mm = i % 2 == 0 ? 0.0 : 2.0 * static_cast<double>(i);
  settings[2].force_shading = true;
  std::vector<FingerState> states(settings.size());
  std::vector<FingerState> single_states(settings.size());
  std::vector<Vec3> tips(settings.size());
  std::vector<FingerOutput> outputs(settings.size());
  int touching = 0;
  for (int tick = 0; tick < 400; ++tick) {
    for (std::size_t i = 0; i < tips.size(); ++i) {
      const double along = 10.0 + 0.2 * tick;
      tips[i] = {along, 15.0 + 12.0 * static_cast<double>(i), 8.0 - 0.05 * tick + settings[i].radius_mm};
    }
    stepAll(plate, settings, states, tips, outputs);
    for (std::size_t i = 0; i < tips.size(); ++i) {
      const FingerOutput single = step(plate, settings[i], single_states[i], tips[i]);
      ASSERT_EQ(outputs[i].force, single.force) << tick << ", " << i;
      ASSERT_EQ(outputs[i].proxy, single.proxy) << tick << ", " << i;
      ASSERT_EQ(outputs[i].anchor, single.anchor) << tick << ", " << i;
      ASSERT_EQ(outputs[i].hold, single.hold) << tick << ", " << i;
      ASSERT_EQ(outputs[i].depth_mm, single.depth_mm) << tick << ", " << i;
      ASSERT_EQ(outputs[i].triangle, single.triangle) << tick << ", " << i;
      ASSERT_EQ(outputs[i].status, single.status) << tick << ", " << i;
      touching += touches(single) ? 1 : 0;
    }
  }
  EXPECT_GT(touching, 600);
}

TEST(FingerSettings, ScaleChangesLengthsOnly) {
  const FingerSettings small = scaled(sphereSettings(8.0), 0.001);
  EXPECT_DOUBLE_EQ(small.radius_mm, 0.008);
  EXPECT_DOUBLE_EQ(small.max_depth_mm, 0.04);
  EXPECT_DOUBLE_EQ(small.catch_up_mm_per_s, 0.1);
  EXPECT_DOUBLE_EQ(small.mu_static, 0.46);
  EXPECT_DOUBLE_EQ(small.tick_s, 0.001);
}

TEST(FingerSettings, NonsenseIsNamed) {
  EXPECT_NO_THROW(check(FingerSettings{}));
  EXPECT_THROW(check(sphereSettings(-1.0)), Error);
  EXPECT_THROW(check(sphereSettings(NAN)), Error);
  FingerSettings swapped;
  swapped.mu_dynamic = 0.5;
  EXPECT_THROW(check(swapped), Error);
}

}  // namespace palpate::contact
