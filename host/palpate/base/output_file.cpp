// The partial file lies beside its target, so that the rename stays within one file system. Order: write, fsync, close,
// rename, fsync of the folder; a full disk is told by one of the first three, while the old file is still there, and
// after a power cut there is the old file or the new one, whole. The system's own calls instead of a stream: each write
// tells at once, and a program that is killed leaves what it has written. Cold path.
#include "palpate/base/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <system_error>
#include <utility>

#include "palpate/base/error.h"

namespace palpate {

namespace {

namespace fs = std::filesystem;

constexpr int kMaxLinks = 40;
constexpr mode_t kNewFileMode = 0666;  // less the umask
constexpr mode_t kOwnerMode = 0600;

/// Where everybody may lay a link under any name: the system's folder for temporary files.
bool isOpenFolder(const fs::path& folder) {
  struct stat facts = {};
  return ::stat(folder.empty() ? "." : folder.c_str(), &facts) == 0 && (facts.st_mode & S_ISVTX) != 0 &&
         (facts.st_mode & S_IWOTH) != 0;
}

/// A link on the way to this file that anybody may have laid; empty: none.
fs::path linkOfAnybody(const fs::path& file) {
  fs::path way;
  std::error_code error;
  for (const fs::path& part : file) {
    const fs::path before = way;
    way /= part;
    if (fs::is_symlink(fs::symlink_status(way, error)) && isOpenFolder(before)) return way;
  }
  return {};
}

/// Also those that links lead to. The kernel's own guard (fs.protected_symlinks) does not reach a link that a program
/// reads and follows itself.
void refuseLinksOfAnybody(fs::path target) {
  std::error_code error;
  for (int i = 0; i < kMaxLinks; ++i) {
    if (const fs::path link = linkOfAnybody(target); !link.empty()) {
      throw Error::inFile(link.string(), "is a link in a folder that everybody may write to: name what it leads to");
    }
    if (!fs::is_symlink(fs::symlink_status(target, error))) return;
    const fs::path next = fs::read_symlink(target, error);
    if (error) return;
    target = target.parent_path() / next;
  }
}

/// The file that a chain of links means: renaming onto a link would replace the link.
fs::path withoutLinks(fs::path target) {
  std::error_code error;
  for (int i = 0; i < kMaxLinks && fs::is_symlink(fs::symlink_status(target, error)); ++i) {
    const fs::path next = fs::read_symlink(target, error);
    if (error) break;
    target = target.parent_path() / next;  // an absolute one replaces all
  }
  return target;
}

bool isWrittenDirectly(const fs::path& target) {
  std::error_code error;
  const fs::file_status status = fs::status(target, error);
  return fs::exists(status) && !fs::is_regular_file(status);
}

int create(const fs::path& file, mode_t mode) {
  return ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
}

/// Creates the first partial file beside the target that is not there yet.
int createPartial(const fs::path& target, mode_t mode, fs::path& partial) {
  partial = target.string() + std::string(kPartialExtension);
  int descriptor = create(partial, mode);
  for (int i = 2; descriptor < 0 && errno == EEXIST; ++i) {
    partial = fmt::format("{}.{}{}", target.string(), i, kPartialExtension);
    descriptor = create(partial, mode);
  }
  return descriptor;
}

/// The mode of the file that is replaced; somebody else's never opens ours wider. Where it cannot be kept, the usual
/// one is as good.
void keepMode(int descriptor, const struct stat& old) {
  struct stat fresh = {};
  if (::fstat(descriptor, &fresh) != 0) return;
  const bool ours = old.st_uid == ::geteuid();
  ::fchmod(descriptor, old.st_mode & 0777 & (ours ? mode_t{0777} : fresh.st_mode));
}

/// Some file systems cannot, and say so with one of these; a disk that failed says another.
bool synced(int descriptor) {
  return ::fsync(descriptor) == 0 || errno == EINVAL || errno == ENOTSUP || errno == EROFS;
}

/// The new name. That it cannot be made safe is not told: the file is there, and whole.
void syncFolderOf(const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

std::atomic<int> files_under_way{0};
static_assert(std::atomic<int>::is_always_lock_free);

}  // namespace

void writePrivateFile(const fs::path& file, std::string_view content) {
  OutputFile output(file, OutputFile::Unfinished::remove, OutputFile::Access::owner_only);
  output.write(content);
  output.commit();
}

void createPrivateFile(const fs::path& file) {
  const int descriptor = create(file, kOwnerMode);
  if (descriptor < 0) {
    throw Error::inFile(file.string(), "cannot be written: " + std::generic_category().message(errno));
  }
  ::close(descriptor);
}

int filesUnderWay() noexcept { return files_under_way.load(); }

OutputFile::UnderWay::UnderWay() { ++files_under_way; }
OutputFile::UnderWay::~UnderWay() { --files_under_way; }

OutputFile::OutputFile(fs::path target, Unfinished unfinished, Access access) : target_(std::move(target)) {
  refuseLinksOfAnybody(target_);
  if (isWrittenDirectly(target_)) {
    written_ = target_;
    descriptor_ = ::open(target_.c_str(), O_WRONLY | O_CLOEXEC);
    check(descriptor_ >= 0);
    return;
  }
  place_ = withoutLinks(target_);
  struct stat old = {};
  const bool replaces = ::stat(place_.c_str(), &old) == 0;
  // A rename asks only the folder: a file that its owner protected stays protected.
  if (replaces) check(::access(place_.c_str(), W_OK) == 0);
  descriptor_ = createPartial(place_, access == Access::owner_only ? kOwnerMode : kNewFileMode, written_);
  check(descriptor_ >= 0);
  removes_ = unfinished == Unfinished::remove;
  if (replaces && access == Access::usual) keepMode(descriptor_, old);
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  std::error_code ignored;  // a destructor has nobody to tell
  if (place_.empty()) return;
  if (removes_ || (!committed_ && fs::file_size(written_, ignored) == 0)) fs::remove(written_, ignored);
}

void OutputFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    check(count >= 0);
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  struct stat now = {};
  if (!place_.empty() && ::fstat(descriptor_, &now) == 0 && now.st_nlink == 0) fail(ENOENT);
}

void OutputFile::commit() {
  check(place_.empty() || synced(descriptor_));
  check(::close(std::exchange(descriptor_, -1)) == 0 || errno == EINTR);
  if (place_.empty()) return;
  check(::rename(written_.c_str(), place_.c_str()) == 0);
  removes_ = false;
  committed_ = true;
  syncFolderOf(place_);
}

void OutputFile::check(bool done) const {
  if (!done) fail(errno);
}

void OutputFile::fail(int reason) const {
  throw Error::inFile(target_.string(), "cannot be written: " + std::generic_category().message(reason));
}

}  // namespace palpate
