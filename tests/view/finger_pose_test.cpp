#include "palpate/view/finger_pose.h"

#include <gtest/gtest.h>

#include "palpate/body/hand.h"
#include "palpate/tree/closest_on_triangle.h"
#include "palpate/view/layers/drawn_skin.h"
#include "palpate/view/layers/hand_pose.h"
#include "view/small_world.h"

namespace palpate::view {
namespace {

/// By brute force: from the ball's centre to the nearest deformed triangle.
double distanceToSkin(const scene::World& world, const deform::DeformedSurface& surface, const Vec3& centre) {
  double nearest = 1e300;
  for (const Triangle& triangle : world.skin.triangles) {
    std::array<Vec3, 3> corners;
    for (int i = 0; i < 3; ++i) corners[i] = surface.positionAt(triangle[i]).cast<double>();
    nearest = std::min(nearest, tree::closestOnTriangle(corners, centre).squared_distance);
  }
  return std::sqrt(nearest);
}

TEST(FingerPose, RestsOnTheSkinAndNeverInIt) {
  const auto world = worldOf(zoo::wavyGrid(40, 100.0, 6.0));
  for (const double depth : {0.2, 3.0, 8.0}) {
    for (const Vec3& place : {Vec3(50, 50, 6), Vec3(31, 62, 6), Vec3(75, 25, 6)}) {
      const FingerMark finger = pressedFinger(*world, place - Vec3(0, 0, 6), depth, {2.0, 1.0, 0.0});
      if (finger.contact.touch == contact::Touch::free) continue;
      const auto surface = deformedBy(*world, {&finger, 1});
      DrawnSkin skin;
      skin.copyAll(surface);
      const FingerPose pose = poseOf(*world, skin, finger);
      const double distance = distanceToSkin(*world, surface, pose.centre);
      EXPECT_GT(distance, pose.radius_mm - 0.01);
      EXPECT_LT(distance, pose.radius_mm + 2.0) << "and does not float";
    }
  }
}

TEST(FingerPose, HoversWithItsPadAtThePointOfAFreeFinger) {
  const auto world = flatWorld();
  DrawnSkin skin;
  skin.copyAll(deformedBy(*world, {}));
  FingerMark finger;
  finger.contact.tip = {50.0, 50.0, 20.0};
  EXPECT_LT((poseOf(*world, skin, finger).centre - Vec3(50.0, 50.0, 28.0)).norm(), 1e-6);
  finger.haptic_radius_mm = 8.0;
  EXPECT_LT((poseOf(*world, skin, finger).centre - Vec3(50.0, 50.0, 20.0)).norm(), 1e-6)
      << "a ball's tip is its centre";
}

TEST(HandPose, LaysTheIndexFingertipOnTheSkinAndKeepsTheRestOut) {
  const auto world = worldOf(zoo::grid(60, 900.0));
  for (const bool left : {false, true}) {
    FingerPose finger;
    finger.centre = {450.0, 450.0, 4.0};
    finger.left = left;
    body::HandSettings settings;
    settings.side = left ? body::Side::left : body::Side::right;
    const mesh::TriangleMesh hand = body::makeHand(settings);
    const HandPose pose = handPoseOf(*world, finger, hand);
    EXPECT_NEAR(pose.axes.determinant(), 1.0, 1e-9) << "turned, not mirrored";
    EXPECT_LT((pose.origin + pose.axes * body::indexTip(settings) - finger.centre).norm(), 10.0);
    for (const Vec3& point : hand.positions) {
      const Vec3 place = pose.origin + pose.axes * point;
      EXPECT_TRUE(place.z() > -1.0 || (place - finger.centre).norm() < 40.0) << place.transpose();
    }
  }
}

}  // namespace
}  // namespace palpate::view
