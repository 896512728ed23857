// Names of the library's functions and what its error codes mean. Cold path.
#include "palpate/device/hardware/openhaptics_api.h"
#include "palpate/base/system/process.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace palpate::device::openhaptics {

namespace {

struct KnownError {
  std::uint32_t code;
  std::string_view name;
  std::string_view remedy;
};

constexpr std::string_view kReplug = "check the device's cable and power supply, then plug it in again";
constexpr std::string_view kReport = "this is a bug in the program or the driver; please report it";

constexpr std::array kKnownErrors = {
    KnownError{0x100, "invalid enumerator", kReport},
    KnownError{0x101, "invalid value", kReport},
    KnownError{0x102, "invalid operation", kReport},
    KnownError{0x103, "invalid input type", kReport},
    KnownError{0x104, "bad handle", kReport},
    KnownError{0x200, "warm motors", "let the motors cool down"},
    KnownError{0x201, "force above the maximum", "lower the stiffness or the nominal force of the scene"},
    KnownError{0x202, "force impulse above the maximum", "lower the stiffness of the scene"},
    KnownError{0x203, "velocity above the maximum", "move more slowly"},
    KnownError{0x204, "force error", "release the device and press its button again"},
    KnownError{0x300, "device fault", kReplug},
    KnownError{0x301, "device already initiated", "close the other program that uses it, or name another device"},
    KnownError{0x302, "communication error", kReplug},
    KnownError{0x303, "wrong communication settings", "run the vendor's setup program and choose the device there"},
    KnownError{0x304, "timer error", "close other programs that use the device's driver"},
    KnownError{0x400, "frame begun inside another frame", kReport},
    KnownError{0x401, "frame ended without being begun", kReport},
    KnownError{0x402, "frame error", kReport},
    KnownError{0x500, "invalid priority", kReport},
    KnownError{0x501, "scheduler full", "close other programs that use the device's driver"},
    KnownError{0x600, "invalid licence", "install the OpenHaptics licence, or the run-time driver for this device"},
};

}  // namespace

ErrorWords wordsOf(std::uint32_t code) {
  const auto* known = std::find_if(kKnownErrors.begin(), kKnownErrors.end(),
                                   [&](const KnownError& error) { return error.code == code; });
  if (known == kKnownErrors.end()) return {fmt::format("error 0x{:x}", code), std::string(kReplug)};
  return {fmt::format("{} (0x{:x})", known->name, code), std::string(known->remedy)};
}

std::vector<std::string> libraryNames(const std::string& file) {
  if (system::kIsWindows) return namesToTry(file, kLibraryVariable, {"HD.dll"});
  return namesToTry(file, kLibraryVariable, {"libHD.so", "libHD.so.3.4", "libHD.so.3.4.0", "libHD.so.3.0"});
}

std::vector<std::string> resolveApi(const SharedLibrary& library, Api& api) {
  std::vector<std::string> missing;
  resolveNeeded(library, "hdInitDevice", api.init_device, missing);
  resolveNeeded(library, "hdDisableDevice", api.disable_device, missing);
  resolveNeeded(library, "hdMakeCurrentDevice", api.make_current, missing);
  resolveNeeded(library, "hdBeginFrame", api.begin_frame, missing);
  resolveNeeded(library, "hdEndFrame", api.end_frame, missing);
  resolveNeeded(library, "hdGetError", api.get_error, missing);
  resolveNeeded(library, "hdEnable", api.enable, missing);
  resolveNeeded(library, "hdGetIntegerv", api.get_integers, missing);
  resolveNeeded(library, "hdGetDoublev", api.get_doubles, missing);
  resolveNeeded(library, "hdGetString", api.get_string, missing);
  resolveNeeded(library, "hdSetDoublev", api.set_doubles, missing);
  resolveNeeded(library, "hdCheckCalibration", api.check_calibration, missing);
  resolveNeeded(library, "hdUpdateCalibration", api.update_calibration, missing);
  resolveNeeded(library, "hdStartScheduler", api.start_scheduler, missing);
  resolveNeeded(library, "hdStopScheduler", api.stop_scheduler, missing);
  resolveNeeded(library, "hdScheduleAsynchronous", api.schedule, missing);
  resolveNeeded(library, "hdUnschedule", api.unschedule, missing);
  resolve(library, "hdGetErrorString", api.error_string);
  return missing;
}

}  // namespace palpate::device::openhaptics
