// `palpate devices --identify`: what a device swallows and how late it is, measured on itself
// (device_identification.h), and the lines of a scene file that say so.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/device/device_identification.h"

namespace palpate::app {

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
nlohmann::ordered_json jsonOf(const Identified& found);

}  // namespace palpate::app
