// A doctor's report on a vendor's library and on the bus: the same questions for every back end that has one.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "palpate/device/back_ends.h"
#include "palpate/device/hardware/shared_library.h"
#include "palpate/device/hardware/usb_search.h"

namespace palpate::device {

struct LibraryRemedies {
  std::string variable;  ///< the environment variable that names the file
  std::string install;   ///< where the library comes from
  /// A dependency's name begins so -> where that one comes from.
  std::vector<std::pair<std::string, std::string>> dependencies;
};

struct LibraryFindings {
  std::string what;
  const SharedLibrary& library;
  const std::vector<std::string>& missing_functions;
  LibraryRemedies remedies;
};

/// Every name that was tried, in the loader's words; reason and remedy when it did not open or lacks functions.
void reportLibrary(const LibraryFindings& findings, Probe& probe);

/// Whether a device of these makers is on the bus.
void reportPlugged(std::string_view makers, std::span<const UsbDevice> plugged, Probe& probe);

/// A driver without a device reports less than the bus: nothing plugged in, or no right to open it.
void explainByBus(std::span<const UsbDevice> plugged, std::string_view rule_name, Probe& probe);

}  // namespace palpate::device
