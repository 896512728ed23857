// The edge to plugins (palpate_device.h): turns data of a stranger's library into data that the servo may rely on, or a
// text about its fault. Pure functions.
#pragma once

#include <cstddef>
#include <string>

#include "palpate/device/detail/driver_link.h"
#include "palpate/device/device.h"
#include "palpate/device/device_frame.h"
#include "palpate/device/palpate_device.h"

namespace palpate::device::plugin {

/// No plugin has a longer name or line about itself.
inline constexpr std::size_t kMaxNameBytes = 128;
/// The room that a plugin gets for its words.
inline constexpr std::size_t kWordsRoom = 512;

/// The fault of a table; empty: none.
std::string findFault(const palpate_device_table* table);

/// The text in a room of `bytes` bytes, fit for a message: it ends at its first NUL or where the room does.
std::string boundedText(const char* room, std::size_t bytes);

/// Invalid sizes become "does not say", an invalid box becomes empty.
Capabilities checkedCapabilities(const palpate_device_capabilities& able, const DeviceFrame& frame);

/// A checked reading in the body frame: not a number, too far and too old are faults.
DriverReading checkReading(int answer, const palpate_device_reading& reading, const DeviceFrame& frame, double tick_s);

}  // namespace palpate::device::plugin
