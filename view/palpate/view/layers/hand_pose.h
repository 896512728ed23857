// How a hand is held whose index finger's pad rests on the skin: from caudal and a little from its own side, steep
// enough that its other parts stay off the body. No GL.
#pragma once

#include "palpate/body/hand.h"
#include "palpate/scene/world.h"
#include "palpate/view/finger_pose.h"

namespace palpate::view {

/// From the hand's frame (body/hand.h) to the body's: place = origin + axes * point.
struct HandPose {
  Mat3 axes = Mat3::Identity();
  Vec3 origin = Vec3::Zero();
};

/// The pad of the index finger lies where the finger's ball meets the skin; the hand is held as flat as its other parts
/// allow without sinking into the skin at rest, and lifted where even that is not enough. `hand` must be the one of
/// that side.
HandPose handPoseOf(const scene::World& world, const FingerPose& finger, const body::PalpatingHand& hand);

}  // namespace palpate::view
