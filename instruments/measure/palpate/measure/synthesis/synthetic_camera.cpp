#include "palpate/measure/synthesis/synthetic_camera.h"

#include <algorithm>
#include <cmath>

namespace palpate::measure {

namespace {

/// Share of half the frame that the back may fill.
constexpr double kFill = 0.94;
/// No picture of two megapixels has more; others in proportion.
constexpr double kMaxPixelsPerMm = 3.2;

}  // namespace

void SyntheticCamera::stand(const CameraPose& pose, const Vec3& aim, double roll_rad) {
  const double out = std::sin(pose.tilt_rad);
  const Vec3 direction(out * std::cos(pose.tilt_azimuth_rad), out * std::sin(pose.tilt_azimuth_rad),
                       std::cos(pose.tilt_rad));
  eye_ = aim + pose.distance_mm * direction;
  forward_ = -direction;
  const Vec3 level = forward_.cross(Vec3::UnitY()).normalized();
  right_ = Eigen::AngleAxisd(roll_rad, forward_) * level;
  up_ = right_.cross(forward_);
}

SyntheticCamera::SyntheticCamera(const SyntheticCase& made, const SyntheticBody& body, bool later) {
  const CameraPose& pose = made.camera;
  const Vec3 aim = body.placeAt(pose.aim_mm);
  distance_mm_ = pose.distance_mm;
  distortion_ = pose.distortion;
  middle_px_ = 0.5 * Vec2(made.width_px - 1, made.height_px - 1);
  stand(pose, aim, pose.roll_rad);
  // The longest lens with which the rim of the back is in the frame.
  const double most = kMaxPixelsPerMm * std::sqrt(made.width_px * 1e-6 * made.height_px / 2.0);
  focal_px_ = most * pose.distance_mm;
  for (double along = -1.0; along <= 1.0; along += 0.1) {
    for (const Vec2& rim : {Vec2(along, 1.0), Vec2(along, -1.0), Vec2(1.0, along), Vec2(-1.0, along)}) {
      const Vec2 seen = projectUndistorted(body.placeAt(rim.cwiseProduct(Vec2(kHalfWidthMm, kHalfLengthMm))));
      const Vec2 room = kFill * middle_px_.cwiseQuotient(seen.cwiseAbs().cwiseMax(1e-9));
      focal_px_ = std::min({focal_px_, room.x(), room.y()});
    }
  }
  corner_ = middle_px_.norm() / focal_px_;
  if (!later) return;
  stand(pose, aim, pose.roll_rad + pose.later_roll_rad);
  eye_ += pose.later_shift_mm.x() * right_ + pose.later_shift_mm.y() * up_;
}

Vec2 SyntheticCamera::projectUndistorted(const Vec3& place) const {
  const Vec3 offset = place - eye_;
  return Vec2(right_.dot(offset), -up_.dot(offset)) / forward_.dot(offset);
}

Vec2 SyntheticCamera::project(const Vec3& place) const {
  const Vec2 bare = projectUndistorted(place);
  return middle_px_ + focal_px_ * (1.0 + distortion_ * bare.squaredNorm() / (corner_ * corner_)) * bare;
}

}  // namespace palpate::measure
