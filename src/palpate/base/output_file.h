// Writing a file that appears complete or not at all.
#pragma once

#include <cstdio>
#include <filesystem>
#include <string_view>

namespace palpate {

/// Writes to `<target>.partial` and renames it on `commit`; without a commit nothing is left behind. A target that is
/// no regular file (a pipe, a device) is written directly. Every failure throws Error with the target's name.
class OutputFile {
 public:
  explicit OutputFile(std::filesystem::path target);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view bytes);
  /// Flushes, closes and gives the file its name: the moment at which a full disk is noticed at the latest.
  void commit();

 private:
  [[noreturn]] void fail() const;

  std::filesystem::path target_;
  std::filesystem::path written_;  // where the bytes go until the commit
  std::FILE* stream_ = nullptr;
};

}  // namespace palpate
