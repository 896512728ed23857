// Camera -> virtual screen through its centre -> frustum of an eye before it: a skewed pyramid by similar triangles,
// then a turn into the screen's axes (Kooima 2008; camera.h).
#include "palpate/view/camera.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "palpate/base/error.h"

namespace palpate::view {

namespace {

Mat4f frustumMatrix(double left, double right, double bottom, double top, double near, double far) {
  Eigen::Matrix4d m = Eigen::Matrix4d::Zero();
  m(0, 0) = 2.0 * near / (right - left);
  m(0, 2) = (right + left) / (right - left);
  m(1, 1) = 2.0 * near / (top - bottom);
  m(1, 2) = (top + bottom) / (top - bottom);
  m(2, 2) = -(far + near) / (far - near);
  m(2, 3) = -2.0 * far * near / (far - near);
  m(3, 2) = -1.0;
  return m.cast<float>();
}

}  // namespace

Mat3 Camera::axes() const {
  using Eigen::AngleAxisd;
  return (AngleAxisd(yaw_rad, Vec3::UnitY()) * AngleAxisd(-pitch_rad, Vec3::UnitX()) *
          AngleAxisd(roll_rad, Vec3::UnitZ()))
      .toRotationMatrix();
}

Camera fitted(const Eigen::AlignedBox3d& box, double aspect, StandardView side) {
  constexpr double kQuarter = std::numbers::pi / 2.0;
  // Straight above, the up direction is undefined; a hair off it looks the same.
  constexpr double kAlmostAbove = kQuarter - 1e-3;
  Camera camera;
  if (side == StandardView::left) camera.yaw_rad = -kQuarter;
  if (side == StandardView::right) camera.yaw_rad = kQuarter;
  if (side == StandardView::front) camera.yaw_rad = 2.0 * kQuarter;
  if (side == StandardView::above) camera.pitch_rad = kAlmostAbove;
  if (side == StandardView::below) camera.pitch_rad = -kAlmostAbove;
  if (side == StandardView::table) {
    camera.yaw_rad = -kTableYawRad;
    camera.roll_rad = -kQuarter;
  }
  return fitted(box, aspect, camera);
}

Camera fitted(const Eigen::AlignedBox3d& box, double aspect, Camera camera) {
  if (box.isEmpty()) return camera;
  camera.centre = box.center();
  const Vec3 half = 0.5 * box.diagonal();
  const double half_height = half.cwiseProduct(camera.up().cwiseAbs()).sum();
  const double half_width = half.cwiseProduct(camera.right().cwiseAbs()).sum();
  const double half_depth = half.cwiseProduct(camera.backward().cwiseAbs()).sum();
  constexpr double kMargin = 1.05;
  const double reach = kMargin * std::max(half_height, half_width / aspect);
  camera.distance_mm = std::max(reach / std::tan(0.5 * camera.height_rad), 1e-6) + half_depth;
  return camera;
}

Screen cameraScreen(const Camera& camera, double aspect) {
  const double half_height = camera.distance_mm * std::tan(0.5 * camera.height_rad);
  const Vec3 up = half_height * camera.up();
  const Vec3 right = aspect * half_height * camera.right();
  return {camera.centre - right - up, camera.centre + right - up, camera.centre - right + up};
}

Frustum makeFrustum(const Screen& screen, const Vec3& eye, double near_mm, double far_mm) {
  const Vec3 right = (screen.lower_right - screen.lower_left).normalized();
  const Vec3 up = (screen.upper_left - screen.lower_left).normalized();
  const Vec3 normal = right.cross(up).normalized();
  const Vec3 to_left = screen.lower_left - eye;
  const double distance = -normal.dot(to_left);
  if (!(distance > 0.0)) throw Error("the eye must be in front of the screen");
  const double scale = near_mm / distance;
  Frustum frustum;
  frustum.eye = eye;
  frustum.projection = frustumMatrix(scale * right.dot(to_left), scale * right.dot(screen.lower_right - eye),
                                     scale * up.dot(to_left), scale * up.dot(screen.upper_left - eye), near_mm, far_mm);
  Eigen::Matrix4d view = Eigen::Matrix4d::Identity();
  view.block<1, 3>(0, 0) = right.transpose();
  view.block<1, 3>(1, 0) = up.transpose();
  view.block<1, 3>(2, 0) = normal.transpose();
  view.block<3, 1>(0, 3) = -view.block<3, 3>(0, 0) * eye;
  frustum.view = view.cast<float>();
  return frustum;
}

Ray rayThrough(const Screen& screen, const Vec3& eye, double x, double y) {
  const Vec3 place =
      screen.upper_left + x * (screen.lower_right - screen.lower_left) + y * (screen.lower_left - screen.upper_left);
  return {eye, (place - eye).normalized()};
}

Mat4f Frustum::clipFrom(const Vec3& origin) const {
  if (origin.isZero(0.0)) return clip();
  Mat4f moved = view;
  const Mat3 turn = view.block<3, 3>(0, 0).cast<double>();
  moved.block<3, 1>(0, 3) = (turn * (origin - eye)).cast<float>();
  return projection * moved;
}

Vec2 seenAt(const Frustum& frustum, const Vec3& point) {
  const Eigen::Vector4f clip = frustum.clipFrom(point) * Vec3f::Zero().homogeneous();
  if (!(clip.w() > 0.0f)) return Vec2::Constant(std::numeric_limits<double>::quiet_NaN());
  return {0.5 + 0.5 * clip.x() / clip.w(), 0.5 - 0.5 * clip.y() / clip.w()};
}

}  // namespace palpate::view
