// The used part of OpenHaptics' HDAPI, in declarations of our own: its library is opened at run time, no SDK is needed
// to build. Calling convention, widths and numbers: OpenHaptics 3.0 to 3.4, x86-64.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "palpate/device/hardware/shared_library.h"

namespace palpate::device::openhaptics {

using Handle = std::uint32_t;
inline constexpr Handle kInvalidHandle = 0xFFFFFFFFu;

/// Returned by value: three words of 32 bits.
struct ErrorInfo {
  std::uint32_t code;
  int internal_code;
  Handle device;
};
static_assert(sizeof(ErrorInfo) == 12);

using Callback = std::uint32_t (*)(void* user_data);
inline constexpr std::uint32_t kCallbackDone = 0;
inline constexpr std::uint32_t kCallbackContinue = 1;
/// The highest: the servo's force goes out before anything else that is scheduled.
inline constexpr std::uint16_t kMaxPriority = 65535;

/// Names of parameters that can be read and set.
enum Parameter : std::uint32_t {
  kCurrentButtons = 0x2000,             ///< int, a bit a button
  kCurrentPosition = 0x2050,            ///< 3 double, mm
  kCurrentVelocity = 0x2051,            ///< 3 double, mm/s
  kApiVersion = 0x2500,                 ///< text
  kModelType = 0x2501,                  ///< text
  kDriverVersion = 0x2502,              ///< text
  kUsableWorkspace = 0x2551,            ///< 6 double, mm: low xyz, high xyz
  kCalibrationStyle = 0x2555,           ///< int, bits of CalibrationStyle
  kUpdateRate = 0x2600,                 ///< int, Hz
  kNominalMaxStiffness = 0x2602,        ///< double, N/mm
  kNominalMaxForce = 0x2603,            ///< double, N
  kNominalMaxContinuousForce = 0x2604,  ///< double, N
  kCurrentForce = 0x2700,               ///< 3 double, N
  kForceOutput = 0x4000,                ///< switched on by enable
};

enum Calibration : std::uint32_t { kCalibrated = 0x5000, kNeedsUpdate = 0x5001, kNeedsManualInput = 0x5002 };
enum CalibrationStyle : std::uint32_t { kEncoderReset = 1, kAutomatic = 2, kInkwell = 4 };

enum ErrorCode : std::uint32_t {
  kSuccess = 0,
  kWarmMotorsError = 0x200,
  kExceededMaxForce = 0x201,
  kExceededMaxVelocity = 0x203,
  kAlreadyInitiated = 0x301,
  kInvalidLicense = 0x600,
};
/// Warm motors and exceeded limits: the driver reports them and continues, and so do we.
inline constexpr bool isHarmless(std::uint32_t code) { return (code & 0xFF00u) == 0x200u; }

/// Text of an error code, and its remedy.
struct ErrorWords {
  std::string name;
  std::string remedy;
};
ErrorWords wordsOf(std::uint32_t code);

struct Api {
  Handle (*init_device)(const char* name) = nullptr;
  void (*disable_device)(Handle) = nullptr;
  void (*make_current)(Handle) = nullptr;
  void (*begin_frame)(Handle) = nullptr;
  void (*end_frame)(Handle) = nullptr;
  ErrorInfo (*get_error)() = nullptr;
  void (*enable)(std::uint32_t) = nullptr;
  void (*get_integers)(std::uint32_t, int*) = nullptr;
  void (*get_doubles)(std::uint32_t, double*) = nullptr;
  const char* (*get_string)(std::uint32_t) = nullptr;
  void (*set_doubles)(std::uint32_t, const double*) = nullptr;
  std::uint32_t (*check_calibration)() = nullptr;
  void (*update_calibration)(std::uint32_t style) = nullptr;
  void (*start_scheduler)() = nullptr;
  void (*stop_scheduler)() = nullptr;
  unsigned long (*schedule)(Callback, void*, std::uint16_t priority) = nullptr;
  void (*unschedule)(unsigned long) = nullptr;
  const char* (*error_string)(std::uint32_t) = nullptr;  ///< optional
};

/// The environment variable that names the library's file.
inline constexpr const char* kLibraryVariable = "PALPATE_LIBHD";

/// The names that are tried, in their order; only `file` where it is not empty.
std::vector<std::string> libraryNames(const std::string& file);

/// Fills in the library's functions; returns the names of functions that are needed and missing.
std::vector<std::string> resolveApi(const SharedLibrary& library, Api& api);

}  // namespace palpate::device::openhaptics
