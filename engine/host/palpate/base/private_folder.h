// Folders and files for their owner's eyes alone, and where temporary files go: never under a name that others can
// foresee.
#pragma once

#include <filesystem>
#include <string_view>

namespace palpate {

/// Treatment of an existing folder.
enum class ExistingFolder { left, closed };

/// Makes the folder with mode 0700, and those above it with the usual one. `closed`: an existing one of ours is closed
/// to others too. Throws Error.
void makePrivateFolder(const std::filesystem::path& folder, ExistingFolder existing = ExistingFolder::left);

/// Throws Error unless it is a folder, no link, that belongs to this user and is closed to all others.
void requirePrivateFolder(const std::filesystem::path& folder);

/// Users other than the owner who may read and write a file.
enum class OtherReaders { none, group };
/// Throws Error for a file that is not there, and for one that still others may read or write.
void requireClosedFile(const std::filesystem::path& file, OtherReaders others = OtherReaders::none);

/// A fresh folder of mode 0700, "<stem>-XXXXXX", where temporary files belong. Throws Error.
std::filesystem::path newTemporaryFolder(std::string_view stem);

/// A newTemporaryFolder that is removed with the object, with its contents.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(std::string_view stem) : path_(newTemporaryFolder(stem)) {}
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Where a running program keeps what only its own user may see: $XDG_RUNTIME_DIR/palpate, or palpate-UID where
/// temporary files belong. Made when it is not there. Throws Error for another user's folder.
std::filesystem::path runtimeFolder();

}  // namespace palpate
