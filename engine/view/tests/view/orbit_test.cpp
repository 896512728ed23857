#include "palpate/view/orbit.h"

#include <gtest/gtest.h>

#include "palpate/base/random.h"
#include "support/mesh_zoo.h"

namespace palpate::view {
namespace {

constexpr double kWindowAspect = 1.6;
constexpr double kWindowHeight = 800.0;

Vec2 seen(const Camera& camera, const Vec3& point) {
  return seenAt(makeFrustum(cameraScreen(camera, kWindowAspect), camera.eye(), 1.0, 1e5), point);
}

Camera randomCamera(Random& random) {
  Camera camera;
  camera.centre = Vec3(random.uniform(-200, 200), random.uniform(-200, 200), random.uniform(-50, 50));
  camera.yaw_rad = random.uniform(-3, 3);
  camera.pitch_rad = random.uniform(-1.2, 1.2);
  camera.distance_mm = random.uniform(300, 2000);
  return camera;
}

Vec3 pointBefore(const Camera& camera, Random& random) {
  return camera.centre + random.uniform(-80, 80) * camera.right() + random.uniform(-80, 80) * camera.up() +
         random.uniform(-100, 100) * camera.backward();
}

/// Calls check(camera, a point before it, a way of the mouse) for many.
template <class Check>
void forAnyView(std::uint64_t seed, const Check& check) {
  Random random(seed);
  for (int i = 0; i < 500; ++i) {
    const Camera camera = randomCamera(random);
    const Vec3 point = pointBefore(camera, random);
    check(camera, point, Vec2(random.uniform(-300, 300), random.uniform(-50, 50)));
  }
}

TEST(Orbit, KeepsThePivotWhereItAppears) {
  forAnyView(1, [](const Camera& camera, const Vec3& pivot, const Vec2& by) {
    EXPECT_LT((seen(orbited(camera, pivot, by, kWindowHeight), pivot) - seen(camera, pivot)).norm(), 1e-4);
  });
}

TEST(Orbit, DraggingToTheRightBringsThePatientsLeftSideForward) {
  const Camera camera;
  const Camera turned = orbited(camera, camera.centre, Vec2(100, 0), kWindowHeight);
  EXPECT_GT(seen(turned, camera.centre + 100.0 * Vec3::UnitZ()).x(), 0.5) << "what is nearest follows the hand";
  EXPECT_GT(
      seen(orbited(camera, camera.centre, Vec2(0, 100), kWindowHeight), camera.centre + 100.0 * Vec3::UnitZ()).y(),
      0.5);
}

TEST(Orbit, WhatIsNearFollowsTheDragHoweverTheCameraIsRolled) {
  for (const double roll : {0.0, -1.5708, 1.5708, 0.6}) {
    Camera camera;
    camera.yaw_rad = -0.9;
    camera.roll_rad = roll;
    const Vec3 near = camera.centre + 100.0 * camera.backward();
    for (const Vec2& by : {Vec2(60, 0), Vec2(0, 60), Vec2(-40, 30)}) {
      const Camera turned = orbited(camera, camera.centre, by, kWindowHeight);
      const Vec2 moved = seen(turned, near) - seen(camera, near);
      EXPECT_GT(moved.dot(by), 0.95 * moved.norm() * by.norm()) << "roll " << roll << ", by " << by.transpose();
    }
  }
}

TEST(Orbit, NeverTipsOver) {
  const Camera steep = orbited({}, Vec3::Zero(), Vec2(0, 1e5), kWindowHeight);
  EXPECT_LE(steep.pitch_rad, kSteepestRad);
}

TEST(Pan, TheGrabbedPointFollowsTheCursor) {
  forAnyView(2, [](const Camera& camera, const Vec3& grabbed, const Vec2& by) {
    const Vec2 expected =
        seen(camera, grabbed) + Vec2(by.x() / (kWindowHeight * kWindowAspect), by.y() / kWindowHeight);
    EXPECT_LT((seen(panned(camera, grabbed, by, kWindowHeight), grabbed) - expected).norm(), 1e-4);
  });
}

TEST(Zoom, KeepsThePivotWhereItAppearsAndComesNearer) {
  forAnyView(3, [](const Camera& camera, const Vec3& pivot, const Vec2&) {
    const Camera nearer = zoomed(camera, pivot, 2.0);
    EXPECT_LT(nearer.distance_mm, camera.distance_mm);
    EXPECT_LT((seen(nearer, pivot) - seen(camera, pivot)).norm(), 1e-4);
  });
}

TEST(Zoom, StopsNearTheSkinAndFarAway) {
  EXPECT_GE(zoomed({}, Vec3::Zero(), 1e4).distance_mm, kNearestMm);
  EXPECT_LE(zoomed({}, Vec3::Zero(), -1e4).distance_mm, kFarthestMm);
}

TEST(Flight, StartsAndEndsAtItsCamerasAndTurnsTheShortWay) {
  Camera from;
  from.yaw_rad = 3.0;
  Camera to;
  to.yaw_rad = -3.0;
  to.centre = Vec3(10, 0, 0);
  EXPECT_LT((between(from, to, 0.0).eye() - from.eye()).norm(), 1e-9);
  EXPECT_LT((between(from, to, 1.0).eye() - to.eye()).norm(), 1e-9);
  EXPECT_NEAR(std::abs(between(from, to, 0.5).yaw_rad), 3.14159, 1e-4);
}

TEST(Centre, LooksStraightAtThePlaceFromAsFarAsBefore) {
  Camera camera;
  camera.yaw_rad = 0.3;
  const Vec3 place(20, 30, 40);
  const Camera centred = centredOn(camera, place);
  EXPECT_LT((seen(centred, place) - Vec2(0.5, 0.5)).norm(), 1e-5);
  EXPECT_NEAR((centred.eye() - place).norm(), (camera.eye() - place).dot(camera.backward()), 1e-9);
}

TEST(Picking, MeetsTheFrontOfTheSkinAndNothingBesideIt) {
  const mesh::TriangleMesh sheet = zoo::grid(20, 200.0);
  const contact::Surface surface = contact::buildSurface(sheet, std::vector<double>(sheet.positions.size(), 0.5));
  const auto hit = skinAlong(surface, {Vec3(50, 60, 300), Vec3(0, 0, -1)});
  ASSERT_TRUE(hit);
  EXPECT_LT((hit->point - Vec3(50, 60, 0)).norm(), 1e-9);
  EXPECT_LT((hit->normal - Vec3::UnitZ()).norm(), 1e-9);
  EXPECT_FALSE(skinAlong(surface, {Vec3(250, 60, 300), Vec3(0, 0, -1)}));
  EXPECT_FALSE(skinAlong(surface, {Vec3(50, 60, -300), Vec3(0, 0, 1)})) << "from behind";
  ASSERT_TRUE(skinNear(surface, {50, 60, 3}, 5.0));
  EXPECT_FALSE(skinNear(surface, {50, 60, 9}, 5.0));
}

TEST(Picking, SmoothsTheNormalOverAFingertip) {
  const mesh::TriangleMesh ball = zoo::sphere(50.0, 3);
  const contact::Surface surface = contact::buildSurface(ball, std::vector<double>(ball.positions.size(), 0.5));
  for (const Vec3& direction : {Vec3(0.3, 0.5, 1), Vec3(-1, 0.2, 0.1), Vec3(0.11, -0.7, 0.2)}) {
    const Vec3 out = direction.normalized();
    const auto place = skinAlong(surface, {100.0 * out, -out});
    ASSERT_TRUE(place);
    EXPECT_GT(place->normal.dot(out), std::cos(0.04));
  }
}

}  // namespace
}  // namespace palpate::view
