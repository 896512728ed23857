// What `palpate devices` found, for a person and for a script.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "cli/devices/device_measurement.h"
#include "palpate/device/back_ends.h"

namespace palpate::app {

struct DeviceFinding {
  const device::BackEnd* back_end = nullptr;
  device::Probe probe;
  std::optional<device::Capabilities> capabilities;  ///< of one that was opened, like the measurement
  std::optional<DeviceMeasurement> measured;
  std::string not_measured;  ///< why, where it should have been
};

/// Keys carry their units; docs/reference/devices.md lists them.
nlohmann::ordered_json jsonOf(const DeviceFinding& finding);

/// Name, whether it is there, why not and what mends it; with everything that was looked for when `whole`.
std::string textOf(const DeviceFinding& finding, bool whole);

}  // namespace palpate::app
