// What every shader wants to know of the eye: where it is, what it sees, and where the light comes from.
#pragma once

#include "palpate/view/camera.h"
#include "palpate/view/gl_objects.h"

namespace palpate::view {

/// Directions to the lights, unit vectors of the body frame. They follow the camera's yaw and nothing else: turning the
/// body keeps its relief lit from the side, and looking from above does not flatten it.
struct Lights {
  Vec3f key = Vec3f::UnitZ();   ///< warm, from the cranial left and 57 degrees off the axis: raking light shows dents
  Vec3f fill = Vec3f::UnitZ();  ///< cool and weak, from the other side
};

/// Of a body frame whose y axis points up.
Lights lightsFor(const Frustum& frustum);

struct Viewpoint {
  Mat4f clip = Mat4f::Identity();  ///< body frame -> clip
  Vec3f eye = Vec3f::Zero();
  Vec3f backward = Vec3f::UnitZ();  ///< unit, from the picture to the eye
  Lights lights;
  Vec2f pixels = Vec2f::Ones();    ///< of the viewport
  float pixels_per_radian = 1.0f;  ///< in the middle of the picture: pixels of 1 mm at 1 mm, divide by the distance

  /// At the nearest place of a box; infinite within it.
  float pixelsPerMm(const Eigen::AlignedBox3f& box) const { return pixels_per_radian / box.exteriorDistance(eye); }
};

Viewpoint viewpointOf(const Frustum& frustum, int width, int height);

/// Sets the uniforms of kSharedShader; the program must be in use.
void setViewpoint(const Program& program, const Viewpoint& viewpoint);

}  // namespace palpate::view
