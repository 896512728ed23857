// `palpate devices --identify`: a device's mass, damping, friction and delay, measured on itself
// (device_identification.h), and the lines of a scene file for them.
#pragma once

#include <string>
#include <vector>

#include "palpate/base/json.h"
#include "palpate/base/progress.h"
#include "palpate/device/device_identification.h"

namespace palpate::app {

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
