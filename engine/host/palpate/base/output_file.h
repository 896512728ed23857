// The one way in which the product writes a file: it appears complete or not at all.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "palpate/base/made_folder.h"

namespace palpate {

/// Makes the target's folder if it is missing, and removes it again if it stays empty. Writes next to the target, to
/// `<target>.partial` (or `.2.partial`, ...: the file of an interrupted run is never overwritten), and gives it the
/// target's name on `commit`, when it is safe on the disk. Until then an older file stays unchanged; without a commit
/// nothing new is left. Targets other than regular files (a pipe, a device) are written directly; links are followed,
/// except in a folder where all users may make one (sticky, as /tmp). Every failure throws Error with the target's name
/// and the system's reason.
class OutputFile {
 public:
  /// Fate of the partial file without a commit.
  enum class Unfinished { remove, keep };  // keep: the bytes written, if any
  /// Readers of the file. `owner_only`: mode 0600 from its first byte, whatever stood there; for secrets and for what a
  /// person did. `usual`: as the umask says, or as the file that it replaces.
  enum class Access { usual, owner_only };

  explicit OutputFile(std::filesystem::path target, Unfinished unfinished = Unfinished::remove,
                      Access access = Access::usual);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Hands the bytes to the system at once: collect small ones. Fails also when the file was deleted meanwhile.
  void write(std::string_view bytes);
  /// Nothing may be written afterwards.
  void commit();
  /// From now on written bytes stay, even without a commit.
  void retainUnfinished() noexcept { removes_ = false; }

  /// Where the bytes are until the commit.
  const std::filesystem::path& partial() const { return written_; }

 private:
  /// One of filesUnderWay().
  struct UnderWay {
    UnderWay();
    ~UnderWay();
    UnderWay(const UnderWay&) = delete;
    UnderWay& operator=(const UnderWay&) = delete;
  };
  [[noreturn]] void fail(int reason) const;
  void check(bool done) const;

  UnderWay under_way_;
  std::optional<MadeFolder> folder_;
  std::filesystem::path target_;   // as the caller named it
  std::filesystem::path place_;    // the file that becomes of it; empty: the target is written directly
  std::filesystem::path written_;  // where the bytes go until the commit
  bool removes_ = false;           // the partial file, without a commit
  bool committed_ = false;
  int descriptor_ = -1;
};

/// Writes the whole file for its owner alone, replacing an older one. Throws Error.
void writePrivateFile(const std::filesystem::path& file, std::string_view content);

/// An empty file for its owner alone, in a folder that is made if missing. Throws Error if the file exists.
void createPrivateFile(const std::filesystem::path& file);

/// Number of files that the process is writing now; may be called in a signal's handler.
int filesUnderWay() noexcept;

/// The extension of a file that was not finished.
inline constexpr std::string_view kPartialExtension = ".partial";

}  // namespace palpate
