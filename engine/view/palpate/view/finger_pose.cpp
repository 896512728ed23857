// A finger's contact -> the ball that is drawn: laid on the deformed anchor along the contact's normal, then lifted in
// rounds, each by the most that a triangle round it needs, until none reaches into it.
#include "palpate/view/finger_pose.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "palpate/tree/triangle_tree.h"
#include "palpate/view/drawn_skin.h"

namespace palpate::view {

namespace {

using Corners = std::array<Vec3, 3>;

/// Skin moves by at most this much (the default caps of 10 and 20 mm together): skin farther from the ball at rest
/// cannot reach it.
constexpr double kReachMm = 25.0;

Corners deformedCorners(const DrawnSkin& skin, const tree::TriangleRecord& record) {
  return {skin.at(record.vertices[0]), skin.at(record.vertices[1]), skin.at(record.vertices[2])};
}

/// Place and normal that the ball is laid on.
struct Support {
  Vec3 place;   ///< the ball's lowest point
  Vec3 normal;  ///< unit
  Vec3 rest;    ///< middle of the skin that may be near, at rest
};

Vec3 deformedAnchor(const scene::World& world, const DrawnSkin& skin, const contact::FingerOutput& contact) {
  const Triangle& corners = world.body->skin.triangles[contact.anchor_triangle];
  Corners rest;
  for (int i = 0; i < 3; ++i) rest[i] = world.body->skin.positions[corners[i]];
  const Vec3 weights = tree::barycentricWeights(rest, contact.anchor);
  Vec3 place = Vec3::Zero();
  for (int i = 0; i < 3; ++i) place += weights[i] * skin.at(corners[i]);
  return place;
}

Vec3 smoothNormal(const contact::Surface& surface, Index record_index, const Vec3& place) {
  const tree::TriangleRecord& record = surface.geometry->tree.records[record_index];
  const Vec3 weights = tree::barycentricWeights(record.corners, place);
  Vec3 normal = Vec3::Zero();
  for (int i = 0; i < 3; ++i) normal += weights[i] * surface.geometry->vertex_normals[record.vertices[i]];
  return normal.norm() > 0.0 ? Vec3(normal.normalized()) : Vec3(Vec3::UnitZ());
}

Support findSupport(const scene::World& world, const DrawnSkin& skin, const FingerMark& finger) {
  const contact::FingerOutput& contact = finger.contact;
  if (contact.touch != contact::Touch::free && contact.anchor_triangle < world.body->skin.triangles.size()) {
    return {deformedAnchor(world, skin, contact), contact.normal, contact.anchor};
  }
  const auto nearest =
      tree::nearestPoint(world.surface.geometry->tree, contact.tip, std::numeric_limits<double>::max());
  if (nearest.triangle == kNoIndex) return {contact.tip, Vec3::UnitZ(), contact.tip};
  const Vec3 normal = smoothNormal(world.surface, nearest.triangle, nearest.closest.point);
  return {contact.tip - finger.haptic_radius_mm * normal, normal, nearest.closest.point};
}

std::vector<Corners> skinAround(const scene::World& world, const DrawnSkin& skin, const Vec3& rest, double reach) {
  std::vector<Corners> triangles;
  tree::visitNearTriangles(world.surface.geometry->tree, rest, reach * reach, [&](Index record, const auto&) {
    triangles.push_back(deformedCorners(skin, world.surface.geometry->tree.records[record]));
    return reach * reach;
  });
  return triangles;
}

/// Distance that the ball must move along its normal so that this triangle no longer reaches into it; a first guess
/// when the triangle is at its side, so the caller repeats it.
double liftOver(const FingerPose& pose, const Corners& triangle) {
  const auto closest = tree::closestOnTriangle(triangle, pose.centre);
  const double distance = std::sqrt(closest.squared_distance);
  if (distance >= pose.radius_mm) return 0.0;
  constexpr double kMinCosine = 0.3;  // below, the step would overshoot by far
  const double cosine = distance > 0.0 ? pose.normal.dot(pose.centre - closest.point) / distance : 1.0;
  return (pose.radius_mm - distance) / std::max(cosine, kMinCosine);
}

void liftOut(FingerPose& pose, const std::vector<Corners>& triangles) {
  constexpr int kMaxRounds = 12;
  constexpr double kTouchMm = 1e-3;
  for (int round = 0; round < kMaxRounds; ++round) {
    double lift = 0.0;
    for (const Corners& triangle : triangles) lift = std::max(lift, liftOver(pose, triangle));
    pose.centre += lift * pose.normal;
    if (lift < kTouchMm) return;
  }
}

}  // namespace

contact::PressurePad fingerPad(const scene::Scene& scene, std::size_t finger) {
  if (finger >= scene.fingers.size() || scene.fingers[finger].pad == 0) return {};
  return {scene.fingers[finger].pad, scene.fingers[finger].pad_mm};
}

FingerPose computeFingerPose(const scene::World& world, const DrawnSkin& skin, const FingerMark& finger) {
  FingerPose pose;
  pose.radius_mm = finger.radius_mm;
  pose.touches = finger.contact.touch != contact::Touch::free;
  pose.colour = finger.colour;
  pose.left = finger.left;
  pose.outline = finger.outline;
  pose.centre = finger.contact.tip;
  if (skin.vertices() == 0) return pose;
  const Support support = findSupport(world, skin, finger);
  pose.normal = support.normal;
  pose.centre = support.place + pose.radius_mm * pose.normal;
  liftOut(pose, skinAround(world, skin, support.rest, pose.radius_mm + kReachMm));
  return pose;
}

}  // namespace palpate::view
