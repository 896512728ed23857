// mkdir with its mode instead of chmod afterwards: there is no moment at which others may look in.
#include "palpate/base/private_folder.h"

#include <fmt/format.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

#include "palpate/base/error.h"

namespace palpate {

namespace {

namespace fs = std::filesystem;

constexpr mode_t kOwnerOnly = 0700;
constexpr mode_t kOthers = 0077;

[[noreturn]] void failWith(const fs::path& folder, int reason) {
  throw Error::inFile(folder.string(), "cannot be made: " + std::generic_category().message(reason));
}

/// Of the folder itself, not of what a link leads to.
bool isOurFolder(const fs::path& folder, struct stat& facts) {
  return ::lstat(folder.c_str(), &facts) == 0 && S_ISDIR(facts.st_mode) && facts.st_uid == ::geteuid();
}

}  // namespace

void makePrivateFolder(const fs::path& folder, ExistingFolder existing) {
  std::error_code error;
  if (folder.has_parent_path()) fs::create_directories(folder.parent_path(), error);
  if (error) failWith(folder, error.value());
  if (::mkdir(folder.c_str(), kOwnerOnly) == 0) return;
  const int reason = errno;
  if (reason != EEXIST || !fs::is_directory(folder, error)) failWith(folder, reason);
  struct stat facts = {};
  const bool open = existing == ExistingFolder::closed && isOurFolder(folder, facts) && (facts.st_mode & kOthers) != 0;
  if (open && ::chmod(folder.c_str(), facts.st_mode & kOwnerOnly) != 0) failWith(folder, errno);
}

void requirePrivateFolder(const fs::path& folder) {
  struct stat facts = {};
  if (isOurFolder(folder, facts) && (facts.st_mode & kOthers) == 0) return;
  throw Error::inFile(folder.string(), "must be a folder of this user alone (mode 700, no link)");
}

fs::path newTemporaryFolder(std::string_view stem) {
  std::string name = (fs::temp_directory_path() / fmt::format("{}-XXXXXX", stem)).string();
  if (::mkdtemp(name.data()) == nullptr) failWith(name, errno);
  return name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

fs::path runtimeFolder() {
  const char* named = std::getenv("XDG_RUNTIME_DIR");  // NOLINT(concurrency-mt-unsafe)
  // The specification of base directories: a relative path there is to be ignored.
  const bool has_one = named != nullptr && *named == '/' && ::access(named, W_OK) == 0;
  const fs::path folder =
      has_one ? fs::path(named) / "palpate" : fs::temp_directory_path() / fmt::format("palpate-{}", ::geteuid());
  if (::mkdir(folder.c_str(), kOwnerOnly) != 0 && errno != EEXIST) failWith(folder, errno);
  requirePrivateFolder(folder);
  return folder;
}

}  // namespace palpate
