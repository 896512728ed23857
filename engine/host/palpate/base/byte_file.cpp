#include "palpate/base/byte_file.h"

#include <system_error>

namespace palpate {

ByteFile::ByteFile(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return;
  size_ = std::filesystem::file_size(file, error);
  if (error) size_ = 0;
  stream_.open(file, std::ios::binary);
}

bool ByteFile::read(std::uint64_t at, std::size_t count, std::string& bytes) {
  if (at > size_ || count > size_ - at) return false;
  bytes.resize(count);
  stream_.clear();
  stream_.seekg(static_cast<std::streamoff>(at));
  return static_cast<bool>(stream_.read(bytes.data(), static_cast<std::streamsize>(count)));
}

}  // namespace palpate
