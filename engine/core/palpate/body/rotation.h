// A turn about an axis with the same bits everywhere: Eigen's AngleAxis uses the C library's sine and cosine.
#pragma once

#include <numbers>

#include "palpate/base/elementary.h"
#include "palpate/base/vec.h"

namespace palpate::body {

/// Rounds the product first: times kRadPerDeg some angles differ in their last bit, and built-in bodies with them.
inline double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

/// Rodrigues' formula; `axis` is a unit vector, the turn right-handed.
inline Mat3 rotationAbout(const Vec3& axis, double angle_rad) {
  const double cosine = elementary::cos(angle_rad);
  const Vec3 sine = elementary::sin(angle_rad) * axis;
  const Vec3 rest = (1.0 - cosine) * axis;
  Mat3 rotation = rest * axis.transpose();
  rotation.diagonal().array() += cosine;
  rotation(1, 0) += sine.z();
  rotation(0, 1) -= sine.z();
  rotation(0, 2) += sine.y();
  rotation(2, 0) -= sine.y();
  rotation(2, 1) += sine.x();
  rotation(1, 2) -= sine.x();
  return rotation;
}

}  // namespace palpate::body
