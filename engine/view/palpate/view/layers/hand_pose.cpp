// A ball on the skin -> the pose of its hand: the flattest angle at which no other part of the hand is in the skin at
// rest, found by halving and tested against the tree at every seventh vertex; any remaining depth lifts the whole hand.
#include "palpate/view/layers/finger_layer.h"

#include <algorithm>
#include <cmath>

#include "palpate/tree/triangle_tree.h"

namespace palpate::view {

namespace {

/// Angle between the pad's joint and the skin: as flat as the other parts allow, within these; how far the hand comes
/// from its own side instead of straight from below; and its turn about its length, the little finger's side up.
/// Radians.
constexpr double kFlattest = 0.64;
constexpr double kSteepest = 1.35;
constexpr double kAside = 0.45;
constexpr double kRoll = 0.10;
/// Every kStride-th vertex of the hand is tested for being in the skin, except within kTipMm of the tip: it is in its
/// dent.
constexpr std::size_t kStride = 7;
constexpr double kTipMm = 35.0;

/// Cranial along the skin; where the skin faces up or down, dorsal.
Vec3 cranialAlong(const Vec3& normal) {
  const Vec3 cranial = Vec3::UnitY() - normal.y() * normal;
  constexpr double kMin = 1e-2;
  if (cranial.norm() > kMin) return cranial.normalized();
  return (Vec3::UnitZ() - normal.z() * normal).normalized();
}

/// `steepness` is that of the index finger's last joint, which is bent against the hand.
Mat3 axesAt(const FingerPose& finger, const body::PalpatingHand& hand, double steepness) {
  const Vec3& up = finger.normal;
  const Vec3 heading = fingerHeading(up, finger.left);
  const double slope = steepness - std::asin(std::clamp(-hand.pad_along.z(), -1.0, 1.0));
  Mat3 axes;
  axes.col(1) = std::cos(slope) * heading - std::sin(slope) * up;
  axes.col(2) = std::sin(slope) * heading + std::cos(slope) * up;
  axes.col(0) = axes.col(1).cross(axes.col(2));
  // The thumb is at the right hand's -x and the left hand's +x.
  return axes * Eigen::AngleAxisd(finger.left ? kRoll : -kRoll, Vec3::UnitY()).toRotationMatrix();
}

/// The vertices between the tested ones may be this much deeper.
constexpr double kClearanceMm = 2.0;

/// Depth of a point in the skin at rest or too near to it; 0 outside, and beyond `reach`.
double depthIn(const contact::Surface& surface, const Vec3& point, double reach) {
  const auto nearest = tree::nearestPoint(surface.geometry->tree, point, reach);
  if (nearest.triangle == kNoIndex) return 0.0;
  const auto& corners = surface.geometry->tree.records[nearest.triangle].corners;
  const Vec3 normal = mesh::areaVector2(corners[0], corners[1], corners[2]).normalized();
  return std::max(0.0, kClearanceMm - normal.dot(point - nearest.closest.point));
}

/// Reach of the pulp beyond the pad's middle towards the skin.
double padReach(const body::PalpatingHand& hand, const Mat3& axes, const Vec3& down) {
  constexpr double kPulpMm = 13.0;
  double reach = 0.0;
  for (const Vec3& point : hand.mesh.positions) {
    const Vec3 away = point - hand.pad;
    if (away.squaredNorm() < kPulpMm * kPulpMm) reach = std::max(reach, down.dot(axes * away));
  }
  return reach;
}

/// The hand at this angle with its pad where the ball meets the skin.
HandPose heldAt(const FingerPose& finger, const body::PalpatingHand& hand, double size, double steepness) {
  HandPose pose;
  pose.axes = size * axesAt(finger, hand, steepness);
  const Vec3 contact = finger.centre - finger.radius_mm * finger.normal;
  const double reach = padReach(hand, pose.axes, -finger.normal);
  pose.origin = contact + reach * finger.normal - pose.axes * hand.pad;
  return pose;
}

double deepestPart(const scene::World& world, const FingerPose& finger, const body::PalpatingHand& hand,
                   const HandPose& pose) {
  constexpr double kDeepestMm = 40.0;
  double deepest = 0.0;
  for (std::size_t v = 0; v < hand.mesh.positions.size(); v += kStride) {
    const Vec3 place = pose.origin + pose.axes * hand.mesh.positions[v];
    if ((place - finger.centre).norm() < kTipMm) continue;
    deepest = std::max(deepest, depthIn(world.surface, place, kDeepestMm));
  }
  return deepest;
}

}  // namespace

Vec3 fingerHeading(const Vec3& normal, bool left) {
  const Vec3 cranial = cranialAlong(normal);
  const double aside = left ? kAside : -kAside;
  return std::cos(aside) * cranial + std::sin(aside) * cranial.cross(normal);
}

HandPose computeHandPose(const scene::World& world, const FingerPose& finger, const body::PalpatingHand& hand,
                         double size) {
  double flat = kFlattest;
  double steep = kSteepest;
  constexpr int kHalvings = 5;  // to a degree
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (flat + steep);
    (deepestPart(world, finger, hand, heldAt(finger, hand, size, middle)) > 0.0 ? flat : steep) = middle;
  }
  HandPose pose = heldAt(finger, hand, size, steep);
  pose.origin += deepestPart(world, finger, hand, pose) * finger.normal;
  return pose;
}

}  // namespace palpate::view
