// How quick and how regular an opened device is: measured for a second or so, at zero force.
#pragma once

#include <cstdint>
#include <string>

#include "palpate/base/progress.h"
#include "palpate/device/device.h"
#include "palpate/servo/histogram.h"

namespace palpate::app {

struct DeviceMeasurement {
  double seconds = 0.0;
  double positions_per_s = 0.0;         ///< new ones
  servo::DurationPercentiles interval;  ///< between two of them
  servo::DurationPercentiles delay;     ///< from sending a force to the first position that was read after it
  double with_position_share = 0.0;     ///< of the time
  std::string trouble;                  ///< in words, at the end; empty: none
};

/// Asks 20,000 times a second, which is how finely times are told; a device that answers at once is asked once a tick.
/// Ends early when a signal asked for it.
DeviceMeasurement measureDevice(const device::Device& device, double seconds, const Progress& progress);

}  // namespace palpate::app
