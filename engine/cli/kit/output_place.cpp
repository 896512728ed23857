#include "cli/kit/output_place.h"

#include <functional>
#include <string>
#include <system_error>

#include "palpate/base/made_folder.h"
#include "palpate/base/output_file.h"
#include "palpate/base/path_text.h"

namespace palpate::app {

namespace {

namespace fs = std::filesystem;

/// Appears for a moment only, as a partial file.
constexpr const char* kProbe = "palpate-can-write";

Option* tried(Option* option, const std::function<void(const fs::path&)>& require) {
  return option->check([require](const std::string& name) {
    if (!name.empty()) require(pathOf(name));
    return std::string();
  });
}

}  // namespace

void requireWritableFile(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status)) return;
  const OutputFile probe(file);
}

void requireWritableFolder(const fs::path& folder) {
  const MadeFolder made(folder);
  const OutputFile probe(folder / kProbe);
}

Option* namesFileToWrite(Option* option) { return tried(option, requireWritableFile); }
Option* namesFolderToWrite(Option* option) { return tried(option, requireWritableFolder); }

}  // namespace palpate::app
