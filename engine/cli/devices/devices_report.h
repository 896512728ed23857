// The findings and measurements of `palpate devices`, as text and as JSON.
#pragma once

#include <optional>
#include <string>

#include "palpate/base/json.h"
#include "palpate/base/progress.h"
#include "palpate/device/back_ends.h"
#include "palpate/device/device.h"
#include "palpate/servo/histogram.h"

namespace palpate::app {

// Rate and regularity of an opened device: measured for a second or so, at zero force.

struct DeviceMeasurement {
  double seconds = 0.0;
  double positions_per_s = 0.0;         ///< new ones
  servo::DurationPercentiles interval;  ///< between two of them
  servo::DurationPercentiles delay;     ///< from sending a force to the first position read after it
  double with_position_share = 0.0;     ///< share of the time
  std::string trouble;                  ///< at the end; empty: none
};

/// Polls 20,000 times a second, which is the resolution in time; a device that answers at once is read once a tick.
/// Ends early on a signal.
DeviceMeasurement measureDevice(const device::Device& device, double seconds, const Progress& progress);

struct DeviceFinding {
  const device::BackEnd* back_end = nullptr;
  device::Probe probe;
  std::optional<device::Capabilities> capabilities;  ///< for an opened device, like the measurement
  std::optional<DeviceMeasurement> measured;
  std::string not_measured;  ///< why, where it should have been
  std::string why_nothing;   ///< there was nothing to measure
};

/// Keys carry their units; docs/reference/devices.md lists them.
Json toJson(const DeviceFinding& finding);

/// Name, whether it is available, why not and the remedy; with every place that was searched when `whole`.
std::string textOf(const DeviceFinding& finding, bool whole);

}  // namespace palpate::app
