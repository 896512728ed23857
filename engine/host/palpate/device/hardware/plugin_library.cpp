// The loader -> palpate_device_plugin -> its table, checked. Cold path.
#include "palpate/base/path_text.h"
#include "palpate/device/hardware/plugin_driver.h"

#include <algorithm>
#include <cstdlib>

#include "palpate/base/system/library.h"
#include "palpate/base/system/process.h"
#include "palpate/base/text.h"
#include "palpate/device/detail/each_back_end.h"
#include "palpate/device/hardware/plugin_checks.h"

namespace palpate::device::plugin {

namespace {

namespace fs = std::filesystem;

constexpr const char* kFunction = "palpate_device_plugin";

bool isFile(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

/// File of a name, in the folders; empty: in none of them.
std::string fileInFolders(const std::string& name) {
  const fs::path path = pathOf(name);
  if (name.empty() || path.has_root_path() || path.has_parent_path()) return {};
  for (const fs::path& folder : folders()) {
    for (const std::string& file :
         {name, name + system::libraryExtension(), "lib" + name + system::libraryExtension()}) {
      if (isFile(folder / pathOf(file))) return (folder / pathOf(file)).string();
    }
  }
  return {};
}

/// The file that a name is short for, or the name itself.
std::string fileNamed(const std::string& name) {
  if (name.empty() || pathOf(name).has_parent_path()) return name;
  if (std::string file = fileInFolders(name); !file.empty()) return file;
  return isFile(pathOf(name)) ? "./" + name : name;  // without a slash the loader would look elsewhere
}

}  // namespace

Plugin load(const std::string& file) {
  Plugin plugin;
  plugin.file = file;
  plugin.remedy = "build it again with this version's palpate_device.h (docs/howto/plugins.md)";
  const SharedLibrary library = openLibrary(std::vector<std::string>{file});
  if (!library) {
    plugin.reason = library.attempts.front().words;
    plugin.remedy = "name a plugin's file: plugin:/path/to/it.so (docs/howto/plugins.md)";
    if (const std::string& needs = library.attempts.front().dependency; !needs.empty()) {
      plugin.remedy = "install what it needs: " + needs;
    }
    return plugin;
  }
  decltype(palpate_device_plugin)* function = nullptr;
  resolve(library, kFunction, function);
  if (function == nullptr) {
    plugin.reason = file + " is not a plugin: it has no function " + kFunction;
    return plugin;
  }
  const auto* table = function(PALPATE_DEVICE_VERSION);
  plugin.reason = findFault(table);
  if (plugin.reason.empty()) {
    plugin.table = table;
    plugin.remedy.clear();
  } else {
    plugin.reason = file + ": " + plugin.reason;
  }
  return plugin;
}

std::string nameOf(const Plugin& plugin) { return boundedText(plugin.table->name, kMaxNameBytes); }
std::string pluginDescription(const Plugin& plugin) { return boundedText(plugin.table->about, kMaxNameBytes); }

std::vector<fs::path> folders() {
  const std::string said = system::variable(kFoldersVariable);
  std::vector<fs::path> found;
  for (const std::string_view folder : split(said, system::kBetweenFolders)) {
    if (!folder.empty()) found.push_back(pathOf(folder));
  }
  return found;
}

std::vector<std::string> filesIn(const std::vector<fs::path>& folders) {
  std::vector<std::string> files;
  for (const fs::path& folder : folders) {
    const std::size_t first = files.size();
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
      if (entry->path().extension() == system::libraryExtension()) files.push_back(entry->path().string());
    }
    std::sort(files.begin() + static_cast<std::ptrdiff_t>(first), files.end());
  }
  return files;
}

Wanted parsePluginName(const std::string& words) {
  const std::string whole = fileNamed(words);
  const std::size_t colon = words.rfind(':');
  if (colon == std::string::npos || isFile(pathOf(whole))) return {whole, {}};
  return {fileNamed(words.substr(0, colon)), words.substr(colon + 1)};
}

}  // namespace palpate::device::plugin

namespace palpate::device {

/// parsePluginName takes a file here for the name before it looks at what is before the colon: that must not be one
/// either.
bool isPluginOfFolders(const std::string& which) {
  if (!plugin::fileInFolders(which).empty()) return true;
  const std::size_t colon = which.rfind(':');
  return colon != std::string::npos && !plugin::isFile(pathOf(which)) &&
         !plugin::fileInFolders(which.substr(0, colon)).empty();
}

}  // namespace palpate::device
