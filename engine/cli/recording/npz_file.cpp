#include "cli/recording/npz_file.h"

#include <fmt/format.h>

#include <bit>
#include <cerrno>
#include <cstring>
#include <utility>

#include "cli/recording/zip_archive.h"
#include "palpate/base/error.h"

namespace palpate::app {

namespace {

/// Most bytes for minizip at once; its lengths have 32 bits.
constexpr std::size_t kMaxAtOnce = std::size_t{1} << 30;
/// From here on an entry needs the larger form of the archive.
constexpr std::uint64_t kLarge = 0xf0000000u;
constexpr int kStored = 0;

/// The head of a .npy file: its length with the ten bytes before it is a multiple of 64.
std::string makeNpyHeader(std::string_view type, const std::string& shape) {
  std::string words = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': {}, }}", type, shape);
  words.append(63 - (10 + words.size()) % 64, ' ');
  words += '\n';
  std::string head("\x93NUMPY\x01\x00", 8);
  head += static_cast<char>(words.size() & 0xffu);
  head += static_cast<char>(words.size() >> 8);
  return head + words;
}

}  // namespace

struct NpzFile::Archive {
  zipFile handle = nullptr;
  ~Archive() {
    if (handle != nullptr) zipClose(handle, nullptr);
  }
};

NpzFile::NpzFile(const std::filesystem::path& file)
    : name_(file.string()), file_(file), archive_(std::make_unique<Archive>()) {
  archive_->handle = newZipArchive(file_.partial());
  if (archive_->handle == nullptr) fail();
}

NpzFile::~NpzFile() = default;

void NpzFile::fail() const {
  const int reason = errno;
  throw Error::inFile(name_, fmt::format("cannot be written: {}", reason == 0 ? "the archive" : std::strerror(reason)));
}

void NpzFile::add(const std::string& name, std::string_view type, std::uint64_t count, std::string_view bytes) {
  add(name, makeNpyHeader(type, fmt::format("({},)", count)), bytes, bytes.size() > kLarge);
}

void NpzFile::addSquares(const std::string& name, std::uint64_t count, std::size_t side,
                         std::span<const float> values) {
  static_assert(std::endian::native == std::endian::little);
  const std::string_view bytes(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  add(name, makeNpyHeader("<f4", fmt::format("({}, {}, {})", count, side, side)), bytes, bytes.size() > kLarge);
}

void NpzFile::add(const std::string& name, double number) {
  add(name, makeNpyHeader("<f8", "()"), std::string_view(reinterpret_cast<const char*>(&number), sizeof number), false);
}

void NpzFile::add(const std::string& name, std::string_view header, std::string_view bytes, bool is_large) {
  errno = 0;
  const zip_fileinfo info{};  // without a date: the same recording gives the same file
  const std::string entry = name + ".npy";
  if (zipOpenNewFileInZip64(archive_->handle, entry.c_str(), &info, nullptr, 0, nullptr, 0, nullptr, kStored, 0,
                            is_large ? 1 : 0) != ZIP_OK) {
    fail();
  }
  for (std::string_view rest : {header, bytes}) {
    while (!rest.empty()) {
      const std::string_view now = rest.substr(0, kMaxAtOnce);
      if (zipWriteInFileInZip(archive_->handle, now.data(), static_cast<unsigned>(now.size())) != ZIP_OK) fail();
      rest.remove_prefix(now.size());
    }
  }
  if (zipCloseFileInZip(archive_->handle) != ZIP_OK) fail();
}

void NpzFile::commit() {
  errno = 0;
  const zipFile handle = std::exchange(archive_->handle, nullptr);
  if (zipClose(handle, nullptr) != ZIP_OK) fail();
  file_.commit();
}

}  // namespace palpate::app
