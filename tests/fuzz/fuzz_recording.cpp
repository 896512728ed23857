// Any bytes as a session file, and as a block of one: read, or refused with an Error.
#include <unistd.h>
#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "palpate/base/error.h"
#include "palpate/trace/recording_reader.h"
#include "palpate/trace/sample_block.h"

namespace {

using namespace palpate::trace;

void readAll(const std::filesystem::path& file) {
  RecordingReader reader(file);
  std::uint64_t ticks = 0;
  for (std::uint64_t world = 0; world < reader.facts().worlds && world < 8; ++world) reader.world(world);
  reader.events();
  reader.damagedBlocks();
  reader.forEachTick({}, [&](std::span<const Sample>) { return ++ticks < 10000; });
}

/// A block whose checksum is right: the bytes are looked at.
void unpack(std::string_view bytes) {
  if (bytes.empty()) return;
  const auto rows = static_cast<std::size_t>(static_cast<unsigned char>(bytes.front()));
  bytes.remove_prefix(1);
  const auto checksum = static_cast<std::uint32_t>(
      ::crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
  unpackSamples(bytes, checksum, rows, 0);
}

/// SQLite wants a file with a name.
class NamedFile {
 public:
  NamedFile()
      : path_(std::filesystem::temp_directory_path() / ("palpate_fuzz_" + std::to_string(::getpid()) + ".session")) {}
  ~NamedFile() { std::filesystem::remove(path_); }
  NamedFile(const NamedFile&) = delete;
  NamedFile& operator=(const NamedFile&) = delete;
  const std::filesystem::path& filledWith(std::string_view bytes) const {
    std::ofstream(path_, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return path_;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    unpack(bytes);
  } catch (const palpate::Error&) {
  }
  static const NamedFile file;
  try {
    readAll(file.filledWith(bytes));
  } catch (const palpate::Error&) {
  }
  return 0;
}
