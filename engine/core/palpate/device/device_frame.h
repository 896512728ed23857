// The frame of a device in the body: the directions of its axes, the length of its unit, its middle.
#pragma once

#include <span>
#include <string_view>

#include "palpate/base/vec.h"

namespace palpate::device {

struct DeviceFrame {
  Mat3 axes = Mat3::Identity();  ///< a rotation: body = axes * device
  double mm = 1.0;               ///< length of the device's unit; a motion is scaled, a force is not
  Vec3 origin_mm = Vec3::Zero();

  Vec3 placeInBody(const Vec3& place) const noexcept { return origin_mm + mm * (axes * place); }
  Vec3 motionInBody(const Vec3& motion) const noexcept { return mm * (axes * motion); }
  Vec3 forceInDevice(const Vec3& force) const noexcept { return axes.transpose() * force; }
};

/// The rotation that text like "y,z,x" or "x,-z,y" names: which device axis the body's x, y and z are. Throws Error for
/// anything else and for a mirror image.
Mat3 axesNamed(std::string_view words);

// Places the workspace of a device in the body by touched places: the tip held on known places.
//
//   three places of the device, three of the body -> rotation, scale, origin, and the residual
//
// The closed form of Umeyama, "Least-squares estimation of transformation parameters between two point patterns", IEEE
// Trans. PAMI 13 (1991), after Horn (1987).

/// Places that are enough.
inline constexpr std::size_t kCalibrationPlaces = 3;

struct Calibration {
  DeviceFrame frame;         ///< from the device's places to the body's
  double residual_mm = 0.0;  ///< root of the mean square of what is left between the places, in the body
};

/// Least squares over three or more pairs. Throws Error, saying which and why, for lists of different lengths, places
/// that are not finite, too near to each other or to a line, and for a scale that no scene may have.
Calibration calibrationOf(std::span<const Vec3> of_device, std::span<const Vec3> of_body);

}  // namespace palpate::device
