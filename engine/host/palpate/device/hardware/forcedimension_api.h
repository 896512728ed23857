// The used part of Force Dimension's DHD library, in declarations of our own: it is opened at run time, no SDK is
// needed to build. Metres, newtons; +x towards the operator, +y to the operator's right, +z up.
#pragma once

#include <string>
#include <vector>

#include "palpate/device/hardware/shared_library.h"
#include "palpate/scene/safety_settings.h"

namespace palpate::device::forcedimension {

/// Answers of the library: below zero an error, above it a remark.
inline constexpr int kTimeGuard = 1;       ///< asked too soon: the data have not changed
inline constexpr int kMotorSaturated = 2;  ///< the force was shortened

/// Every function takes the number of an opened device last.
struct Api {
  int (*device_count)() = nullptr;
  int (*open)(char index) = nullptr;
  int (*close)(char id) = nullptr;
  int (*enable_force)(unsigned char on, char id) = nullptr;
  int (*get_position)(double* x, double* y, double* z, char id) = nullptr;
  int (*set_force)(double x, double y, double z, char id) = nullptr;
  // Optional: old libraries lack some.
  int (*get_velocity)(double* x, double* y, double* z, char id) = nullptr;
  unsigned (*button_mask)(char id) = nullptr;
  int (*button)(int index, char id) = nullptr;
  int (*system_type)(char id) = nullptr;
  const char* (*system_name)(char id) = nullptr;
  const char* (*last_error)() = nullptr;
  void (*sdk_version)(int* major, int* minor, int* release, int* revision) = nullptr;
};

/// The environment variable that names the library's file.
inline constexpr const char* kLibraryVariable = "PALPATE_LIBDHD";

/// The names that are tried, in their order; only `file` where it is not empty.
std::vector<std::string> libraryNames(const std::string& file);

/// Fills in the library's functions; returns the names of functions that are needed and missing.
std::vector<std::string> resolveApi(const SharedLibrary& library, Api& api);

struct Version {
  int major = 0;  ///< 0: unknown
  std::string words;
};
Version readVersion(const Api& api);

/// Published figures of a type of device, used where the library has none.
struct TypeProfile {
  int type;
  const char* model;
  double max_force_n;
  double nominal_stiffness_n_per_mm;
  double reach_mm;                                        ///< radius of the ball that it reaches
  scene::DeviceModel kind = scene::DeviceModel::unknown;  ///< mechanics assumed for it
};
/// Null for a type that is not listed.
const TypeProfile* profileOf(int type);

}  // namespace palpate::device::forcedimension
