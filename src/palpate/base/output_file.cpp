// The partial file lies beside its target, so that the rename stays within one file system. Flush, then rename, then
// close: a full disk is told by the flush, while the old file is still there. No fsync: after a power cut the new file
// may be short. Cold path. Own.
#include "palpate/base/output_file.h"

#include <cerrno>
#include <system_error>
#include <utility>

#include "palpate/base/error.h"

namespace palpate {

namespace {

std::filesystem::path placeToWrite(const std::filesystem::path& target) {
  const auto status = std::filesystem::status(target);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) return target;
  return target.string() + ".partial";
}

}  // namespace

OutputFile::OutputFile(std::filesystem::path target) : target_(std::move(target)), written_(placeToWrite(target_)) {
  stream_ = std::fopen(written_.c_str(), "wb");
  if (stream_ == nullptr) fail();
}

OutputFile::~OutputFile() {
  if (stream_ == nullptr) return;
  std::fclose(stream_);
  std::error_code ignored;  // a destructor has nobody to tell
  if (written_ != target_) std::filesystem::remove(written_, ignored);
}

void OutputFile::write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), stream_) != bytes.size()) fail();
}

void OutputFile::commit() {
  if (std::fflush(stream_) != 0) fail();
  if (written_ != target_ && std::rename(written_.c_str(), target_.c_str()) != 0) fail();
  std::FILE* stream = std::exchange(stream_, nullptr);
  if (std::fclose(stream) != 0) fail();
}

void OutputFile::fail() const {
  const int reason = errno;
  throw Error::inFile(target_.string(), "cannot be written: " + std::generic_category().message(reason));
}

}  // namespace palpate
