// What `palpate devices` found and measured, for a person and for a script.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "palpate/base/json.h"
#include "palpate/base/progress.h"
#include "palpate/device/back_ends.h"
#include "palpate/device/device.h"
#include "palpate/device/device_profile.h"
#include "palpate/servo/histogram.h"

namespace palpate::app {

// How quick and how regular an opened device is: measured for a second or so, at zero force.

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

struct DeviceFinding {
  const device::BackEnd* back_end = nullptr;
  device::Probe probe;
  std::optional<device::Capabilities> capabilities;  ///< of one that was opened, like the measurement
  std::optional<DeviceMeasurement> measured;
  std::string not_measured;  ///< why, where it should have been
  std::string why_nothing;   ///< there was nothing to measure
};

/// Keys carry their units; docs/reference/devices.md lists them.
Json jsonOf(const DeviceFinding& finding);

/// Name, whether it is there, why not and what mends it; with everything that was looked for when `whole`.
std::string textOf(const DeviceFinding& finding, bool whole);

// `palpate devices --identify`: what a device swallows and how late it is, measured on itself
// (device_profile.h), and the lines of a scene file that say so.

struct IdentifySettings {
  std::string device;  ///< empty: the first hardware that is here
  int rounds = 3;
  bool json = false;      ///< what a person should do goes to stderr
  bool realtime = false;  ///< a simulated device too goes by the clock
};

struct Identified {
  std::string words;  ///< that name it
  std::string model;
  bool simulated = false;
  double most_force_n = 0.0;
  std::vector<device::DeviceIdentification> rounds;
  device::DeviceIdentification middle;  ///< the median of each number
  device::DeviceIdentification spread;  ///< greatest minus least
};

/// Opens the device and swings it, after saying what to do where somebody has to let it go. A signal, like any
/// trouble, leaves zero force. Throws Error with the reason, and Ended.
Identified identifyDevice(const IdentifySettings& settings, const Progress& progress);

/// The lines for `[safety]`.
std::string safetyLinesOf(const Identified& found);

std::string textOf(const Identified& found);
/// Keys carry their units; docs/reference/devices.md lists them.
Json jsonOf(const Identified& found);

}  // namespace palpate::app
