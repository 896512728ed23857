// A ball on the skin -> the hand that holds it: the flattest angle at which no other part of the hand is in the skin at
// rest, found by halving and asked of the tree at every third vertex; what still sinks in lifts the whole hand. Own.
#include "palpate/view/layers/hand_pose.h"

#include <algorithm>
#include <cmath>

#include "palpate/body/hand.h"
#include "palpate/tree/triangle_tree.h"

namespace palpate::view {

namespace {

/// Angle between the finger and the skin: as flat as the other fingers allow, within these; and how far the hand comes
/// from its own side instead of straight from below; and turned about the finger, the little finger's side up. Radians.
constexpr double kFlattest = 0.75;
constexpr double kSteepest = 1.35;
constexpr double kAside = 0.30;
constexpr double kRoll = 1.10;
/// Every how many vertices of the hand are asked whether they are in the skin; those within this of the tip are not: it
/// lies in its dent.
constexpr std::size_t kStride = 3;
constexpr double kTipMm = 35.0;

/// Cranial along the skin; where the skin faces up or down, dorsal.
Vec3 cranialAlong(const Vec3& normal) {
  const Vec3 cranial = Vec3::UnitY() - normal.y() * normal;
  constexpr double kLeast = 1e-2;
  if (cranial.norm() > kLeast) return cranial.normalized();
  return (Vec3::UnitZ() - normal.z() * normal).normalized();
}

Mat3 axesAt(const FingerPose& finger, double steepness) {
  const Vec3& up = finger.normal;
  const Vec3 cranial = cranialAlong(up);
  const double aside = finger.left ? kAside : -kAside;
  const Vec3 heading = std::cos(aside) * cranial + std::sin(aside) * cranial.cross(up);
  Mat3 axes;
  axes.col(1) = std::cos(steepness) * heading - std::sin(steepness) * up;
  axes.col(2) = std::sin(steepness) * heading + std::cos(steepness) * up;
  axes.col(0) = axes.col(1).cross(axes.col(2));
  // The thumb is at the right hand's -x and the left hand's +x.
  return axes * Eigen::AngleAxisd(finger.left ? kRoll : -kRoll, Vec3::UnitY()).toRotationMatrix();
}

/// The vertices between those that are asked may lie this much deeper.
constexpr double kClearanceMm = 2.0;

/// How deep a point lies in the skin at rest or too near to it; 0 outside, and beyond `reach`.
double depthIn(const contact::Surface& surface, const Vec3& point, double reach) {
  const auto nearest = tree::nearestPoint(surface.tree, point, reach);
  if (nearest.triangle == kNoIndex) return 0.0;
  const auto& corners = surface.tree.records[nearest.triangle].corners;
  const Vec3 normal = mesh::areaVector2(corners[0], corners[1], corners[2]).normalized();
  return std::max(0.0, kClearanceMm - normal.dot(point - nearest.closest.point));
}

/// The hand held at this angle with its fingertip at the ball's place.
HandPose heldAt(const FingerPose& finger, double steepness) {
  HandPose pose;
  pose.axes = axesAt(finger, steepness);
  const Vec3 pad = body::indexTip() - finger.radius_mm * Vec3::UnitY();
  pose.origin = finger.centre - pose.axes * Vec3(finger.left ? -pad.x() : pad.x(), pad.y(), pad.z());
  return pose;
}

double deepestPart(const scene::World& world, const FingerPose& finger, const mesh::TriangleMesh& hand,
                   const HandPose& pose) {
  constexpr double kDeepestMm = 40.0;
  double deepest = 0.0;
  for (std::size_t v = 0; v < hand.positions.size(); v += kStride) {
    const Vec3 place = pose.origin + pose.axes * hand.positions[v];
    if ((place - finger.centre).norm() < kTipMm) continue;
    deepest = std::max(deepest, depthIn(world.surface, place, kDeepestMm));
  }
  return deepest;
}

}  // namespace

HandPose handPoseOf(const scene::World& world, const FingerPose& finger, const mesh::TriangleMesh& hand) {
  double flat = kFlattest;
  double steep = kSteepest;
  constexpr int kHalvings = 5;  // to a degree
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (flat + steep);
    (deepestPart(world, finger, hand, heldAt(finger, middle)) > 0.0 ? flat : steep) = middle;
  }
  HandPose pose = heldAt(finger, steep);
  pose.origin += deepestPart(world, finger, hand, pose) * finger.normal;
  return pose;
}

}  // namespace palpate::view
