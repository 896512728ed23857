// The partial file is next to its target, so that the rename stays within one file system. Order: write, fsync, close,
// rename, fsync of the folder; one of the first three reports a full disk, while the old file is still there, and after
// a power cut there is the old file or the new one, whole. The system's own calls instead of a stream: each write
// reports at once, and a program that is killed keeps its output. Cold path.
#include "palpate/base/output_file.h"

#include <fmt/format.h>

#include <atomic>
#include <cerrno>
#include <system_error>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/path_text.h"
#include "palpate/base/system/files.h"

namespace palpate {

namespace {

namespace fs = std::filesystem;

constexpr int kMaxLinks = 40;

/// A link on the way to this file that another user may have made; empty: none.
fs::path untrustedLink(const fs::path& file) {
  fs::path way;
  std::error_code error;
  for (const fs::path& part : file) {
    const fs::path before = way;
    way /= part;
    if (fs::is_symlink(fs::symlink_status(way, error)) && system::isOpenToAll(before)) return way;
  }
  return {};
}

/// Also those that links lead to. The kernel's own guard (fs.protected_symlinks) does not reach a link that a program
/// reads and follows itself.
void refuseUntrustedLinks(fs::path target) {
  std::error_code error;
  for (int i = 0; i < kMaxLinks; ++i) {
    if (const fs::path link = untrustedLink(target); !link.empty()) {
      throw Error::inFile(link.string(), "is a link in a world-writable folder; name the file that it points to");
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

/// Creates the first partial file next to the target whose name is free.
int createPartial(const fs::path& target, system::ReadableBy readers, fs::path& partial) {
  partial = withEnding(target, kPartialExtension);
  int descriptor = system::createFile(partial, readers);
  for (int i = 2; descriptor < 0 && errno == EEXIST; ++i) {
    partial = withEnding(target, fmt::format(".{}{}", i, kPartialExtension));
    descriptor = system::createFile(partial, readers);
  }
  return descriptor;
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
  std::error_code error;
  const MadeFolder folder(file.parent_path(), error);  // creating the file reports the error
  const int descriptor = system::createFile(file, system::ReadableBy::owner);
  if (descriptor < 0) {
    throw Error::inFile(file.string(), "cannot be written: " + std::generic_category().message(errno));
  }
  system::close(descriptor);
}

int filesUnderWay() noexcept { return files_under_way.load(); }

OutputFile::UnderWay::UnderWay() { ++files_under_way; }
OutputFile::UnderWay::~UnderWay() { --files_under_way; }

OutputFile::OutputFile(fs::path target, Unfinished unfinished, Access access) : target_(std::move(target)) {
  refuseUntrustedLinks(target_);
  if (isWrittenDirectly(target_)) {
    written_ = target_;
    descriptor_ = system::openForWriting(target_);
    check(descriptor_ >= 0);
    return;
  }
  place_ = withoutLinks(target_);
  std::error_code error;
  folder_.emplace(place_.parent_path(), error);
  if (error) fail(error.value());
  std::error_code ignored;
  const bool replaces = fs::exists(place_, ignored);
  // A rename checks only the folder: a file that its owner protected stays protected.
  if (replaces) check(system::mayWrite(place_));
  const bool usual = access == Access::usual;
  descriptor_ = createPartial(place_, usual ? system::ReadableBy::usual : system::ReadableBy::owner, written_);
  check(descriptor_ >= 0);
  removes_ = unfinished == Unfinished::remove;
  if (replaces && usual) system::copyPermissions(place_, descriptor_);
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) system::close(descriptor_);
  std::error_code ignored;  // a destructor cannot report
  if (place_.empty()) return;
  if (removes_ || (!committed_ && fs::file_size(written_, ignored) == 0)) fs::remove(written_, ignored);
}

void OutputFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const std::ptrdiff_t count = system::writeSome(descriptor_, bytes);
    check(count >= 0);
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  if (!place_.empty() && system::wasDeleted(descriptor_)) fail(ENOENT);
}

void OutputFile::commit() {
  check(place_.empty() || system::flush(descriptor_));
  check(system::close(std::exchange(descriptor_, -1)));
  if (place_.empty()) return;
  check(system::replace(written_, place_));
  removes_ = false;
  committed_ = true;
  system::flushFolder(place_.has_parent_path() ? place_.parent_path() : fs::path("."));
}

void OutputFile::check(bool done) const {
  if (!done) fail(errno);
}

void OutputFile::fail(int reason) const {
  throw Error::inFile(target_.string(), "cannot be written: " + std::generic_category().message(reason));
}

}  // namespace palpate
