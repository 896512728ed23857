// The frame of a device in the body: the directions of its axes, the length of its unit, its middle.
#pragma once

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

}  // namespace palpate::device
