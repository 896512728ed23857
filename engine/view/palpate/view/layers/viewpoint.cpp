// The frame of the lights consists of the camera's right, laid level, and the body's up: that is its yaw without pitch
// and roll. Frustum -> here, once a picture -> uniforms of every program. The shader is in viewpoint.h.
#include "palpate/view/layers/viewpoint.h"

#include "palpate/view/layers/gl_objects.h"

namespace palpate::view {

namespace {

// x to the right, y up, z to the eye of a level camera.
const Vec3f kKeyLight = Vec3f(-0.58f, 0.60f, 0.55f).normalized();
const Vec3f kFillLight = Vec3f(0.80f, -0.10f, 0.59f).normalized();

}  // namespace

Lights lightsFor(const Frustum& frustum) {
  const Vec3f right = frustum.view.block<1, 3>(0, 0).transpose();
  const Vec3f level(right.x(), 0.0f, right.z());
  constexpr float kMinLevel = 1e-3f;  // a camera rolled onto its side has no level right: any yaw will do
  Eigen::Matrix3f axes;
  axes.col(0) = level.norm() > kMinLevel ? Vec3f(level.normalized()) : Vec3f(Vec3f::UnitX());
  axes.col(1) = Vec3f::UnitY();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return {axes * kKeyLight, axes * kFillLight};
}

Viewpoint makeViewpoint(const Frustum& frustum, int width, int height, const Vec3& origin) {
  Viewpoint viewpoint;
  viewpoint.origin = origin;
  viewpoint.clip = frustum.clipFrom(origin);
  viewpoint.eye = viewpoint.drawn(frustum.eye);
  viewpoint.backward = frustum.view.block<1, 3>(2, 0).transpose();
  viewpoint.lights = lightsFor(frustum);
  viewpoint.pixels = {static_cast<float>(width), static_cast<float>(height)};
  const auto& p = frustum.projection;
  viewpoint.near_mm = double{p(2, 3)} / (double{p(2, 2)} - 1.0);
  viewpoint.pixels_per_radian = 0.5f * viewpoint.pixels.y() * frustum.projection(1, 1);
  return viewpoint;
}

void setViewpoint(const Program& program, const Viewpoint& viewpoint) {
  program.set("clip_from_body", viewpoint.clip);
  program.set("eye", viewpoint.eye);
  program.set("lift_mm", viewpoint.lift_mm);
  program.set("backward", viewpoint.backward);
  program.set("to_key", viewpoint.lights.key);
  program.set("to_fill", viewpoint.lights.fill);
}

}  // namespace palpate::view
