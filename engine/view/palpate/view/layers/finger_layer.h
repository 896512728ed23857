// The fingers: balls, or hands and single fingers whose pad is where the ball would be.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "palpate/body/hand.h"
#include "palpate/scene/world.h"
#include "palpate/view/finger_pose.h"
#include "palpate/view/layers/gl_objects.h"
#include "palpate/view/layers/skin_paint.h"
#include "palpate/view/layers/viewpoint.h"

namespace palpate::view {

/// The pose of a hand whose index finger's pad rests on the skin: from caudal and a little from its own side, steep
/// enough that its other parts stay off the body. No GL.
/// From the hand's frame (body/hand.h) to the body's: place = origin + axes * point.
struct HandPose {
  Mat3 axes = Mat3::Identity();  ///< a turn, and a size
  Vec3 origin = Vec3::Zero();
};

/// Along the skin, from the wrist to the tip.
Vec3 fingerHeading(const Vec3& normal, bool left);

/// The pad of the index finger is where the finger's ball meets the skin; the hand is as flat as its other parts allow
/// without sinking into the skin at rest, and lifted where even that is not enough. `hand` must be the one of that
/// side, `size` times as large.
HandPose computeHandPose(const scene::World& world, const FingerPose& finger, const body::PalpatingHand& hand,
                         double size = 1.0);

/// The look of a hand: linear.
struct HandTones {
  double skin = 2.0;     ///< SkinTone
  double near_mm = 1.0;  ///< near plane of the picture
};

class FingerLayer {
 public:
  FingerLayer();
  void drawBalls(std::span<const FingerPose> fingers, const Viewpoint& viewpoint) const;
  /// A whole hand, or a finger alone, as large as the ball would be.
  enum class Form : std::uint8_t { hand, finger };
  /// The pose of a hand, which is made on first use.
  HandPose handPose(const scene::World& world, Form form, const FingerPose& finger);
  /// Parts of a hand, since it fades out at its elbow and before the eye: the opaque part, depth-tested, and the rest,
  /// over everything else. A finger is all opaque.
  enum class Part : std::uint8_t { opaque, fading };
  void drawHand(Form form, const FingerPose& finger, const HandPose& pose, const HandTones& tones,
                const Viewpoint& viewpoint, Part part);
  /// Adds the shapes that throw the shadow of a posed hand.
  void addCasters(Form form, const FingerPose& finger, const HandPose& pose, std::vector<ShadowCaster>& casters);

 private:
  /// A mesh on the graphics card.
  struct Shape {
    GlVertexArray vertex_array;
    GlBuffer places, normals, triangles;
    Index indices = 0;
  };
  struct Hand {
    body::PalpatingHand hand;
    Shape shape;
    GlBuffer redness;
  };
  static Shape uploaded(const mesh::TriangleMesh& mesh);
  static Hand uploaded(body::PalpatingHand made);
  const Hand& hand(Form form, bool left);
  void setHand(const Hand& hand, const FingerPose& finger, const HandTones& tones, const Viewpoint& viewpoint) const;
  void begin(const Viewpoint& viewpoint) const;
  void setShape(const Shape& shape, const FingerPose& finger, const Mat3& axes, const Vec3& origin) const;
  void drawRim(const Shape& shape, const FingerPose& finger, const Viewpoint& viewpoint) const;

  Program program_, hand_program_;
  Shape ball_;
  std::array<std::optional<Hand>, 2> hands_;  // right, left; made when first shown
  std::optional<Hand> finger_;                // for either hand; made when first shown
};

}  // namespace palpate::view
