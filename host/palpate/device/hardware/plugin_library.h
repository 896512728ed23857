// Plugins looked for: a file by its path, or by its name in the folders of PALPATE_DEVICE_PLUGINS.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "palpate/device/hardware/shared_library.h"
#include "palpate/device/palpate_device.h"

namespace palpate::device::plugin {

/// Folders, `:` between them.
inline constexpr const char* kFoldersVariable = "PALPATE_DEVICE_PLUGINS";

struct Plugin {
  std::string file;                             ///< as it was asked for
  const palpate_device_table* table = nullptr;  ///< null: it does not load
  std::string reason;                           ///< why not
  std::string remedy;
};

/// Opens the library and checks its table. It stays in memory until the program ends.
Plugin load(const std::string& file);

/// "point_mass"
std::string nameOf(const Plugin& plugin);
std::string aboutOf(const Plugin& plugin);

/// The folders of the environment's variable.
std::vector<std::filesystem::path> folders();
/// Files of these folders that end in .so, in the order of their names.
std::vector<std::string> filesIn(const std::vector<std::filesystem::path>& folders);

struct Wanted {
  std::string file;   ///< empty: none was named
  std::string which;  ///< of the plugin's devices
};
/// "PATH", "PATH:WHICH", or a NAME that stands for NAME.so or libNAME.so in one of the folders. A colon that belongs to
/// a file's name stays in it.
Wanted wantedOf(const std::string& words);

}  // namespace palpate::device::plugin
