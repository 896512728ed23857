// How a hand is held whose index fingertip rests on the skin: from caudal and a little from its own side, steep enough
// that the other fingers stay off the body. No GL.
#pragma once

#include "palpate/mesh/triangle_mesh.h"
#include "palpate/scene/world.h"
#include "palpate/view/finger_pose.h"

namespace palpate::view {

/// From the hand's frame (body/hand.h) to the body's: place = origin + axes * point.
struct HandPose {
  Mat3 axes = Mat3::Identity();
  Vec3 origin = Vec3::Zero();
};

/// The index fingertip takes the place of the finger's ball; the hand is held as flat as its other parts
/// allow without sinking into the skin at rest, and lifted where even that is not enough. `hand` must be the one of
/// that side.
HandPose handPoseOf(const scene::World& world, const FingerPose& finger, const mesh::TriangleMesh& hand);

}  // namespace palpate::view
