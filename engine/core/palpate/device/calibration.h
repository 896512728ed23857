// Places the workspace of a device in the body by touched places: the tip held on known places.
//
//   three places of the device, three of the body -> rotation, scale, origin, and the residual
//
// The closed form of Umeyama, "Least-squares estimation of transformation parameters between two point patterns", IEEE
// Trans. PAMI 13 (1991), after Horn (1987).
#pragma once

#include <span>

#include "palpate/base/vec.h"
#include "palpate/device/device_frame.h"

namespace palpate::device {

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
