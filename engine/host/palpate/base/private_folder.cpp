#include "palpate/base/private_folder.h"

#include <cerrno>
#include <string>
#include <system_error>

#include "palpate/base/error.h"
#include "palpate/base/path_text.h"
#include "palpate/base/system/files.h"

namespace palpate {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void failWith(const fs::path& folder, int reason) {
  throw Error::inFile(folder.string(), "cannot be created: " + std::generic_category().message(reason));
}

}  // namespace

void makePrivateFolder(const fs::path& folder, ExistingFolder existing) {
  std::error_code error;
  if (folder.has_parent_path()) fs::create_directories(folder.parent_path(), error);
  if (error) failWith(folder, error.value());
  if (system::makeClosedFolder(folder)) return;
  const int reason = errno;
  if (reason != EEXIST || !fs::is_directory(folder, error)) failWith(folder, reason);
  const bool open =
      existing == ExistingFolder::closed && system::isOwnFolder(folder) && !system::isClosedToOthers(folder);
  if (open && !system::closeToOthers(folder)) failWith(folder, errno);
}

void requirePrivateFolder(const fs::path& folder) {
  if (system::isOwnFolder(folder) && system::isClosedToOthers(folder)) return;
  throw Error::inFile(folder.string(), "must be a folder that only this user can access (mode 700, not a link)");
}

void requireClosedFile(const fs::path& file, OtherReaders others) {
  std::error_code error;
  if (!fs::exists(file, error)) {
    throw Error::inFile(file.string(), std::generic_category().message(error ? error.value() : ENOENT));
  }
  const bool closed =
      others == OtherReaders::group ? system::isClosedToStrangers(file) : system::isClosedToOthers(file);
  if (!closed) throw Error::inFile(file.string(), "other users can read or write it: " + system::howToClose(file));
}

fs::path newTemporaryFolder(std::string_view stem) {
  fs::path folder = system::makeTemporaryFolder(stem);
  if (folder.empty()) failWith(fs::temp_directory_path() / pathOf(stem), errno);
  return folder;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

fs::path runtimeFolder() {
  const fs::path folder = system::runtimeFolder();
  if (!system::makeClosedFolder(folder) && errno != EEXIST) failWith(folder, errno);
  requirePrivateFolder(folder);
  return folder;
}

}  // namespace palpate
