// open, fsync, rename and modes. Cold path.
#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>

#include "palpate/base/system/files.h"
#include "palpate/base/system/process.h"

namespace palpate::system {

namespace {

namespace fs = std::filesystem;

constexpr mode_t kNewFile = 0666;  // less the umask
constexpr mode_t kOwnersFile = 0600;
constexpr mode_t kOwnersFolder = 0700;
constexpr mode_t kOthers = 0077;
constexpr mode_t kStrangers = 0007;

bool isClosedTo(mode_t whom, const fs::path& file) {
  struct stat facts = {};
  return ::stat(file.c_str(), &facts) == 0 && (facts.st_mode & whom) == 0;
}

}  // namespace

int createFile(const fs::path& file, ReadableBy readers) {
  const mode_t mode = readers == ReadableBy::owner ? kOwnersFile : kNewFile;
  return ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
}

int openForWriting(const fs::path& file) { return ::open(file.c_str(), O_WRONLY | O_CLOEXEC); }

std::ptrdiff_t writeSome(int descriptor, std::string_view bytes) {
  for (;;) {
    const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
    if (count >= 0 || errno != EINTR) return count;
  }
}

bool flush(int descriptor) {
  // Some file systems cannot, and return one of these; a failed disk returns another.
  return ::fsync(descriptor) == 0 || errno == EINVAL || errno == ENOTSUP || errno == EROFS;
}

bool close(int descriptor) { return ::close(descriptor) == 0 || errno == EINTR; }

bool wasDeleted(int descriptor) {
  struct stat now = {};
  return ::fstat(descriptor, &now) == 0 && now.st_nlink == 0;
}

void copyPermissions(const fs::path& other, int descriptor) {
  struct stat old = {};
  struct stat fresh = {};
  if (::stat(other.c_str(), &old) != 0 || ::fstat(descriptor, &fresh) != 0) return;
  const bool ours = old.st_uid == ::geteuid();
  ::fchmod(descriptor, old.st_mode & 0777 & (ours ? mode_t{0777} : fresh.st_mode));
}

bool replace(const fs::path& file, const fs::path& place) { return ::rename(file.c_str(), place.c_str()) == 0; }

void flushFolder(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

bool mayWrite(const fs::path& file) { return ::access(file.c_str(), W_OK) == 0; }
bool mayReadAndWrite(const fs::path& file) { return ::access(file.c_str(), R_OK | W_OK) == 0; }
bool mayRun(const fs::path& program) { return ::access(program.c_str(), X_OK) == 0; }

bool isOpenToAll(const fs::path& folder) {
  struct stat facts = {};
  return ::stat(folder.empty() ? "." : folder.c_str(), &facts) == 0 && (facts.st_mode & S_ISVTX) != 0 &&
         (facts.st_mode & S_IWOTH) != 0;
}

bool isClosedToOthers(const fs::path& file) { return isClosedTo(kOthers, file); }
bool isClosedToStrangers(const fs::path& file) { return isClosedTo(kStrangers, file); }
std::string howToClose(const fs::path& file) { return "chmod 600 " + file.string(); }

bool isOwnFolder(const fs::path& folder) {
  struct stat facts = {};
  return ::lstat(folder.c_str(), &facts) == 0 && S_ISDIR(facts.st_mode) && facts.st_uid == ::geteuid();
}

// mkdir with its mode instead of chmod afterwards: at no moment may others look in.
bool makeClosedFolder(const fs::path& folder) { return ::mkdir(folder.c_str(), kOwnersFolder) == 0; }

bool closeToOthers(const fs::path& folder) {
  struct stat facts = {};
  return ::lstat(folder.c_str(), &facts) == 0 && ::chmod(folder.c_str(), facts.st_mode & kOwnersFolder) == 0;
}

fs::path makeTemporaryFolder(std::string_view stem) {
  std::string name = (fs::temp_directory_path() / fmt::format("{}-XXXXXX", stem)).string();
  return ::mkdtemp(name.data()) == nullptr ? fs::path() : fs::path(name);
}

fs::path runtimeFolder() {
  const std::string named = variable("XDG_RUNTIME_DIR");
  // The specification of base directories: a relative path there must be ignored.
  if (named.starts_with('/') && mayWrite(named)) return fs::path(named) / "palpate";
  return fs::temp_directory_path() / fmt::format("palpate-{}", ::geteuid());
}

void holdStandardStreams() noexcept {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) >= 0 || errno != EBADF) continue;
    // The lowest free number: this one. Writing there fails, and reports that it fails.
    [[maybe_unused]] const int held = ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
}

}  // namespace palpate::system
