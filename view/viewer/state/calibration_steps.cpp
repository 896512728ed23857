#include "palpate/base/error.h"
#include "view/viewer/state/devices_shown.h"

namespace palpate::viewer {

void CalibrationSteps::take(const Vec3& device, const Vec3& body) {
  trouble.clear();
  of_device.push_back(device);
  of_body.push_back(body);
  if (of_device.size() < device::kCalibrationPlaces) return;
  try {
    found = device::calibrationOf(of_device, of_body);
  } catch (const Error& error) {
    trouble = error.what();
    of_device.clear();
    of_body.clear();
  }
}

}  // namespace palpate::viewer
