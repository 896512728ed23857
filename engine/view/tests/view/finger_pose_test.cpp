#include "palpate/view/finger_pose.h"

#include <gtest/gtest.h>

#include <cmath>

#include "palpate/body/hand.h"
#include "palpate/tree/closest_on_triangle.h"
#include "palpate/view/drawn_skin.h"
#include "palpate/view/layers/finger_layer.h"
#include "view/tests/view/small_world.h"

namespace palpate::view {
namespace {

/// By brute force: from the ball's centre to the nearest deformed triangle.
double distanceToSkin(const scene::World& world, const deform::DeformedSurface& surface, const Vec3& centre) {
  double nearest = 1e300;
  for (const Triangle& triangle : world.body->skin.triangles) {
    std::array<Vec3, 3> corners;
    for (int i = 0; i < 3; ++i) corners[i] = surface.positionAt(triangle[i]).cast<double>();
    nearest = std::min(nearest, tree::closestOnTriangle(corners, centre).squared_distance);
  }
  return std::sqrt(nearest);
}

TEST(FingerPose, RestsOnTheSkinAndNeverInIt) {
  const auto world = meshWorld(zoo::wavyGrid(40, 100.0, 6.0));
  for (const double depth : {0.2, 3.0, 8.0}) {
    for (const Vec3& place : {Vec3(50, 50, 6), Vec3(31, 62, 6), Vec3(75, 25, 6)}) {
      const FingerMark finger = pressedFinger(*world, place - Vec3(0, 0, 6), depth, {2.0, 1.0, 0.0});
      if (finger.contact.touch == contact::Touch::free) continue;
      const auto surface = deformedBy(*world, {&finger, 1});
      DrawnSkin skin;
      skin.copyAll(surface);
      const FingerPose pose = computeFingerPose(*world, skin, finger);
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
  EXPECT_LT((computeFingerPose(*world, skin, finger).centre - Vec3(50.0, 50.0, 28.0)).norm(), 1e-6);
  finger.haptic_radius_mm = 8.0;
  EXPECT_LT((computeFingerPose(*world, skin, finger).centre - Vec3(50.0, 50.0, 20.0)).norm(), 1e-6)
      << "a ball's tip is its centre";
}

/// Right or left, made once.
const body::PalpatingHand& handOf(bool left) {
  static const body::PalpatingHand hands[] = {body::makePalpatingHand(body::Side::right),
                                              body::makePalpatingHand(body::Side::left)};
  return hands[left ? 1 : 0];
}

FingerPose ballAt(const Vec3& centre, bool left) {
  FingerPose finger;
  finger.centre = centre;
  finger.left = left;
  return finger;
}

TEST(HandPose, LaysThePadOfTheIndexFingerOnTheSkinAndKeepsTheRestOut) {
  const auto world = meshWorld(zoo::grid(60, 900.0));
  for (const bool left : {false, true}) {
    const body::PalpatingHand& hand = handOf(left);
    const FingerPose finger = ballAt({450.0, 450.0, 8.0}, left);
    const HandPose pose = computeHandPose(*world, finger, hand);
    EXPECT_NEAR(pose.axes.determinant(), 1.0, 1e-9) << "turned, not mirrored";
    double lowest = 1e300;
    Vec3 touching = Vec3::Zero();
    for (const Vec3& point : hand.mesh.positions) {
      const Vec3 place = pose.origin + pose.axes * point;
      if (place.z() < lowest) touching = place;
      lowest = std::min(lowest, place.z());
      EXPECT_TRUE(place.z() > 1.5 || (place - finger.centre).norm() < 36.0) << place.transpose();
    }
    EXPECT_NEAR(lowest, 0.0, 0.05) << "it touches";
    EXPECT_LT((touching - Vec3(450.0, 450.0, 0.0)).norm(), 6.0) << "where the finger is";
    const Vec3 last_joint = pose.axes * hand.pad_along;
    EXPECT_GT(-last_joint.z(), std::sin(30.0 * kRadPerDeg)) << "it presses";
    EXPECT_LT(-last_joint.z(), std::sin(46.0 * kRadPerDeg)) << "with the pad, not with the end";
    double foremost = -1e300;
    for (const Vec3& point : hand.mesh.positions) {
      const Vec3 place = pose.origin + pose.axes * point;
      if ((place - finger.centre).norm() < 20.0) foremost = std::max(foremost, last_joint.dot(place));
    }
    EXPECT_LT(last_joint.dot(touching), foremost - 2.0) << "under the joint, not before it";
    EXPECT_EQ((pose.axes * hand.forearm).x() < 0.0, left) << "each hand comes from its own side";
  }
}

TEST(HandPose, KeepsOutOfRoundBodies) {
  const double radius = 170.0;
  const auto world = meshWorld(zoo::sphere(radius, 5));
  for (const Vec3& way : {Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0.5, 0.4, -0.8), Vec3(0, -0.9, 0.4)}) {
    FingerPose finger = ballAt((radius + 8.0) * way.normalized(), false);
    finger.normal = way.normalized();
    const HandPose pose = computeHandPose(*world, finger, handOf(false));
    for (const Vec3& point : handOf(false).mesh.positions) {
      const Vec3 place = pose.origin + pose.axes * point;
      EXPECT_TRUE(place.norm() > radius || (place - finger.centre).norm() < 36.0) << way.transpose();
    }
  }
}

}  // namespace
}  // namespace palpate::view
