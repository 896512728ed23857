// Walks over the chunks of a PNG to its end, with their check sums: the decoder finds a missing end only when it is
// there. Based on: W3C PNG Specification, third edition, section 5 (chunks) and 11.
#include <fmt/format.h>
#include <zlib.h>

#include "palpate/base/error.h"
#include "palpate/measure/pictures/picture_header.h"

namespace palpate::measure {

namespace {

constexpr std::size_t kSignatureBytes = 8;
constexpr std::size_t kAroundChunk = 12;  // length, name, check sum

std::size_t bigEndian(std::string_view bytes) {
  std::size_t number = 0;
  for (const char byte : bytes) number = number << 8 | static_cast<unsigned char>(byte);
  return number;
}

struct Chunk {
  std::string_view kind;
  std::string_view data;
};

Chunk chunkAt(std::string_view bytes, std::size_t at, std::string_view name) {
  constexpr std::string_view kTruncated = "is cut off: the end of the picture is missing; copy the file again";
  if (bytes.size() - at < kAroundChunk) throw Error::inFile(name, kTruncated);
  const std::size_t length = bigEndian(bytes.substr(at, 4));
  if (length > bytes.size() - at - kAroundChunk) throw Error::inFile(name, kTruncated);
  const std::string_view checked = bytes.substr(at + 4, length + 4);
  const auto sum = crc32_z(0, reinterpret_cast<const Bytef*>(checked.data()), checked.size());
  if (sum != bigEndian(bytes.substr(at + 8 + length, 4))) {
    throw Error::inFile(name, "is damaged (wrong checksum); copy the file again");
  }
  return {checked.substr(0, 4), checked.substr(4)};
}

void readFrame(const Chunk& chunk, PictureHeader& header, std::string_view name) {
  constexpr std::size_t kFrameBytes = 13;
  if (chunk.kind != "IHDR" || chunk.data.size() != kFrameBytes)
    throw Error::inFile(name, "is a PNG without a header; copy the file again");
  header.width_px = bigEndian(chunk.data.substr(0, 4));
  header.height_px = bigEndian(chunk.data.substr(4, 4));
  header.bits = static_cast<unsigned char>(chunk.data[8]) == 16 ? 16 : 8;
  const auto colours = static_cast<unsigned char>(chunk.data[9]);
  header.is_transparent = colours == 4 || colours == 6;
}

}  // namespace

PictureHeader readPngHeader(std::string_view bytes, std::string_view name) {
  PictureHeader header{.format = PictureFormat::png};
  std::size_t at = kSignatureBytes;
  bool has_picture = false;
  for (bool is_first = true;; is_first = false) {
    const Chunk chunk = chunkAt(bytes, at, name);
    at += chunk.data.size() + kAroundChunk;
    if (is_first) readFrame(chunk, header, name);
    if (chunk.kind == "acTL")
      throw Error::inFile(name, "is an animated PNG; save one picture of it as JPEG, PNG or TIFF");
    if (chunk.kind == "tRNS") header.is_transparent = true;
    if (chunk.kind == "eXIf") header.exif = readExif(chunk.data);
    if (chunk.kind == "IDAT") has_picture = true;
    if (chunk.kind == "IEND") break;
  }
  if (!has_picture) throw Error::inFile(name, "is a PNG without a picture; copy the file again");
  return header;
}

}  // namespace palpate::measure
