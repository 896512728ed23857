// A file that is read in pieces because it is too large, or only partly readable.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace palpate {

class ByteFile {
 public:
  /// Nothing where it cannot be opened: every piece of it is missing.
  explicit ByteFile(const std::filesystem::path& file);

  bool isOpen() const { return stream_.is_open(); }
  std::uint64_t size() const { return size_; }
  /// False at the end of the file or for an error of the disk.
  bool read(std::uint64_t at, std::size_t count, std::string& bytes);

 private:
  std::ifstream stream_;
  std::uint64_t size_ = 0;
};

}  // namespace palpate
