// The synthetic camera: a pinhole with a little distortion, that has the whole back in its frame.
#pragma once

#include "palpate/base/vec.h"
#include "palpate/measure/synthesis/synthetic_body.h"
#include "palpate/measure/synthesis/synthetic_case.h"

namespace palpate::measure {

class SyntheticCamera {
 public:
  /// `later`: where it is for the second picture. The focal length is that of the first.
  SyntheticCamera(const SyntheticCase& made, const SyntheticBody& body, bool later);

  /// Pixels from the centre of the top left one, x to the right, y down.
  Vec2 project(const Vec3& place) const;
  /// Distance along the line of sight.
  double depthOf(const Vec3& place) const { return forward_.dot(place - eye_); }
  const Vec3& eye() const { return eye_; }
  /// In the middle of the back.
  double pixelsPerMm() const { return focal_px_ / distance_mm_; }

 private:
  void stand(const CameraPose& pose, const Vec3& aim, double roll_rad);
  Vec2 projectUndistorted(const Vec3& place) const;

  Vec3 eye_ = Vec3::Zero();
  Vec3 right_ = Vec3::UnitX();
  Vec3 up_ = Vec3::UnitY();
  Vec3 forward_ = -Vec3::UnitZ();
  Vec2 middle_px_ = Vec2::Zero();
  double focal_px_ = 1.0;
  double distance_mm_ = 1.0;
  double distortion_ = 0.0;
  double corner_ = 1.0;  // picture's corner, as the tangent of its angle from the axis
};

}  // namespace palpate::measure
