#include "cli/kit/output_place.h"

#include <functional>
#include <string>
#include <system_error>

#include "palpate/base/error.h"
#include "palpate/base/output_file.h"
#include "palpate/base/path_text.h"

namespace palpate::app {

namespace {

namespace fs = std::filesystem;

/// A file of this name appears for a moment only, as its partial one.
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

MadeFolder::MadeFolder(const fs::path& folder) {
  std::error_code error;
  const fs::path whole = folder.has_filename() ? folder : folder.parent_path();  // "monday/" is "monday"
  if (whole.empty()) return;
  std::vector<fs::path> missing;
  for (fs::path part = whole; !part.empty() && !fs::exists(part, error); part = part.parent_path()) {
    missing.push_back(part);
  }
  fs::create_directories(whole, error);
  const bool stands = fs::is_directory(whole);
  if (!stands && !error) error = std::make_error_code(std::errc::not_a_directory);
  made_ = std::move(missing);
  if (stands) return;
  for (const fs::path& part : made_) {
    std::error_code ignored;
    fs::remove(part, ignored);
  }
  throw Error::inFile(folder.string(), "cannot be made a folder for results: " + error.message());
}

MadeFolder::~MadeFolder() {
  for (const fs::path& part : made_) {
    std::error_code ignored;
    fs::remove(part, ignored);  // refuses what is not empty
  }
}

}  // namespace palpate::app
