// The fingers: balls, or hands whose index fingertip takes the ball's place.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "palpate/body/hand.h"
#include "palpate/scene/world.h"
#include "palpate/view/layers/gl_objects.h"
#include "palpate/view/layers/hand_pose.h"
#include "palpate/view/layers/viewpoint.h"

namespace palpate::view {

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
