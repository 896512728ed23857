// Names of the library's functions, and the devices it knows. Forces, stiffnesses and reaches as CHAI3D 3.3 lists them
// for these devices. Cold path.
#include "palpate/device/hardware/forcedimension_api.h"

#include <fmt/format.h>

#include <array>

#include "palpate/base/system/process.h"

namespace palpate::device::forcedimension {

namespace {

constexpr std::array kProfiles = {
    TypeProfile{33, "omega.3", 12.0, 5.0, 75.0, scene::DeviceModel::omega_3},
    TypeProfile{34, "omega.6", 12.0, 5.0, 75.0, scene::DeviceModel::omega_3},
    TypeProfile{36, "omega.6", 12.0, 5.0, 75.0, scene::DeviceModel::omega_3},
    TypeProfile{35, "omega.7", 12.0, 5.0, 75.0, scene::DeviceModel::omega_3},
    TypeProfile{37, "omega.7", 12.0, 5.0, 75.0, scene::DeviceModel::omega_3},
    TypeProfile{60, "Falcon", 8.0, 3.0, 40.0, scene::DeviceModel::falcon},
    TypeProfile{63, "delta.3", 20.0, 5.0, 150.0},
    TypeProfile{64, "delta.6", 20.0, 5.0, 150.0},
    TypeProfile{104, "sigma.7", 12.0, 4.0, 75.0},
    TypeProfile{105, "sigma.7", 12.0, 4.0, 75.0},
};

}  // namespace

std::vector<std::string> libraryNames(const std::string& file) {
  if (system::kIsWindows) return namesToTry(file, kLibraryVariable, {"drd64.dll", "dhd64.dll"});
  return namesToTry(file, kLibraryVariable, {"libdrd.so.3", "libdhd.so.3", "libdrd.so", "libdhd.so"});
}

std::vector<std::string> resolveApi(const SharedLibrary& library, Api& api) {
  std::vector<std::string> missing;
  resolveNeeded(library, "dhdGetDeviceCount", api.device_count, missing);
  resolveNeeded(library, "dhdOpenID", api.open, missing);
  resolveNeeded(library, "dhdClose", api.close, missing);
  resolveNeeded(library, "dhdEnableForce", api.enable_force, missing);
  resolveNeeded(library, "dhdGetPosition", api.get_position, missing);
  resolveNeeded(library, "dhdSetForce", api.set_force, missing);
  resolve(library, "dhdGetLinearVelocity", api.get_velocity);
  resolve(library, "dhdGetButtonMask", api.button_mask);
  resolve(library, "dhdGetButton", api.button);
  resolve(library, "dhdGetSystemType", api.system_type);
  resolve(library, "dhdGetSystemName", api.system_name);
  resolve(library, "dhdErrorGetLastStr", api.last_error);
  resolve(library, "dhdGetSDKVersion", api.sdk_version);
  return missing;
}

Version readVersion(const Api& api) {
  if (api.sdk_version == nullptr) return {};
  std::array<int, 4> parts{};
  api.sdk_version(parts.data(), &parts[1], &parts[2], &parts[3]);
  return {parts[0], fmt::format("{}.{}.{}.{}", parts[0], parts[1], parts[2], parts[3])};
}

const TypeProfile* profileOf(int type) {
  for (const TypeProfile& profile : kProfiles) {
    if (profile.type == type) return &profile;
  }
  return nullptr;
}

}  // namespace palpate::device::forcedimension
