// The fingers: balls, or hands whose index fingertip takes the ball's place.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "palpate/body/hand.h"
#include "palpate/scene/world.h"
#include "palpate/view/layers/gl_objects.h"
#include "palpate/view/layers/viewpoint.h"
#include "palpate/view/finger_pose.h"

namespace palpate::view {

// How a hand is held whose index fingertip rests on the skin: from caudal and a little from its own side, steep enough
// that the other fingers stay off the body. No GL.

/// From the hand's frame (body/hand.h) to the body's: place = origin + axes * point.
struct HandPose {
  Mat3 axes = Mat3::Identity();
  Vec3 origin = Vec3::Zero();
};

/// The index fingertip takes the place of the finger's ball; the hand is held as flat as its other parts
/// allow without sinking into the skin at rest, and lifted where even that is not enough. `hand` must be the one of
/// that side.
HandPose handPoseOf(const scene::World& world, const FingerPose& finger, const mesh::TriangleMesh& hand);

class FingerLayer {
 public:
  FingerLayer();
  void drawBalls(std::span<const FingerPose> fingers, const Viewpoint& viewpoint) const;
  /// Where hands lie; makes a hand when it is first asked for.
  HandPose handPose(const scene::World& world, const FingerPose& finger);
  void drawHand(const FingerPose& finger, const HandPose& pose, const Viewpoint& viewpoint);

 private:
  /// A mesh on the graphics card.
  struct Shape {
    GlVertexArray vertex_array;
    GlBuffer places, normals, triangles;
    Index indices = 0;
  };
  struct Hand {
    mesh::TriangleMesh mesh;
    Shape shape;
  };
  static Shape uploaded(const mesh::TriangleMesh& mesh);
  const Hand& hand(bool left);
  void begin(const Viewpoint& viewpoint) const;
  void drawShape(const Shape& shape, const FingerPose& finger, const Mat3& axes, const Vec3& origin,
                 const Viewpoint& viewpoint) const;

  Program program_;
  Shape ball_;
  std::array<std::optional<Hand>, 2> hands_;  // right, left; made when first shown
};

}  // namespace palpate::view
