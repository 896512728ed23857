// The findings and measurements of `palpate devices`, as text and as JSON.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "palpate/base/json.h"
#include "palpate/base/progress.h"
#include "palpate/device/back_ends.h"
#include "palpate/device/device.h"
#include "palpate/device/device_identification.h"
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

// `palpate devices --identify`: a device's mass, damping, friction and delay, measured on itself (device_profile.h),
// and the lines of a scene file for them.

struct IdentifySettings {
  std::string device;  ///< empty: the first hardware that is here
  int rounds = 3;
  bool json = false;      ///< instructions to the user go to stderr
  bool realtime = false;  ///< a simulated device, too, runs in real time
};

struct Identified {
  std::string words;  ///< its name
  std::string model;
  bool simulated = false;
  double most_force_n = 0.0;
  std::vector<device::DeviceIdentification> rounds;
  device::DeviceIdentification middle;  ///< the median of each number
  device::DeviceIdentification spread;  ///< greatest minus least
};

/// Opens the device and swings it, after instructions where the user has to release it. A signal, like any fault,
/// leaves zero force. Throws Error with the reason, and Ended.
Identified identifyDevice(const IdentifySettings& settings, const Progress& progress);

/// The lines for `[safety]`.
std::string formatSafetyLines(const Identified& found);

std::string textOf(const Identified& found);
/// Keys carry their units; docs/reference/devices.md lists them.
Json toJson(const Identified& found);

}  // namespace palpate::app
