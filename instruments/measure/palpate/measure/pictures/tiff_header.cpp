// The tags of a TIFF's first page that show whether it is a photograph, and whether all of it is there. Raw pictures of
// cameras are TIFF files too, and hold a small preview first.
// Based on: TIFF Revision 6.0; Adobe DNG 1.6 (its marks).
#include <fmt/format.h>

#include "palpate/base/error.h"
#include "palpate/measure/pictures/picture_header.h"

namespace palpate::measure {

namespace {

enum : std::uint16_t {
  kSubfile = 254,
  kWidth = 256,
  kHeight = 257,
  kBits = 258,
  kCompression = 259,
  kPhotometric = 262,
  kStripOffsets = 273,
  kOrientation = 274,
  kSamples = 277,
  kStripBytes = 279,
  kTileOffsets = 324,
  kTileBytes = 325,
  kExtraSamples = 338,
  kSampleFormat = 339,
  kDngVersion = 50706,
};

void refuseRaw(const TiffDirectory& page, std::string_view bytes, std::string_view name) {
  constexpr std::uint32_t kFirstRawPhotometric = 32803;  // the sensor's own pattern, and DNG's linear raw
  const bool is_preview = (page.number(kSubfile).value_or(0) & 1U) != 0;
  const bool is_raw = page.number(kPhotometric).value_or(0) >= kFirstRawPhotometric;
  const bool is_canon = bytes.substr(8).starts_with("CR\x02");
  if (page.find(kDngVersion) != nullptr || is_preview || is_raw || is_canon) {
    throw Error::inFile(name, "is a raw picture of a camera; develop it and save it as JPEG, PNG or TIFF");
  }
}

void checkColours(const TiffDirectory& page, PictureHeader& header, std::string_view name) {
  constexpr std::uint32_t kPrint = 5;
  if (!page.number(kPhotometric)) throw Error::inFile(name, "is a TIFF without a colour space; save it in RGB");
  if (page.number(kPhotometric) == kPrint) {
    throw Error::inFile(name, "is a TIFF in print colours (CMYK); save it in RGB, as cameras do");
  }
  header.bits = page.number(kBits).value_or(1);
  const bool is_whole = page.number(kSampleFormat).value_or(1) == 1;
  if (!is_whole || (header.bits != 8 && header.bits != 16)) {
    throw Error::inFile(name, fmt::format("is a TIFF of {}{} bits per channel; save it with 8",
                                          is_whole ? "" : "signed or fractional ", header.bits));
  }
  const std::uint32_t samples = page.number(kSamples).value_or(1);
  if (samples == 0 || samples > 4)
    throw Error::inFile(name, fmt::format("is a TIFF of {} channels; save it in RGB", samples));
  const std::uint32_t extra = page.number(kExtraSamples).value_or(0);
  header.is_transparent = extra == 1 || extra == 2;
  header.is_multiplied = extra == 1;
}

std::uint64_t plainBytes(const TiffDirectory& page) {
  const std::uint64_t pixels = std::uint64_t{page.number(kWidth).value_or(0)} * page.number(kHeight).value_or(0);
  return pixels * page.number(kSamples).value_or(1) * (page.number(kBits).value_or(8) / 8);
}

/// Whether the data lies within the file: the decoder pads missing data.
void checkDataInFile(const TiffDirectory& page, std::string_view bytes, std::string_view name) {
  const bool is_tiled = page.find(kTileOffsets) != nullptr;
  const TiffTag* offsets = page.find(is_tiled ? kTileOffsets : kStripOffsets);
  const std::uint16_t lengths = is_tiled ? kTileBytes : kStripBytes;
  bool whole = offsets != nullptr && page.find(lengths) != nullptr;
  std::uint64_t sum = 0;
  for (std::size_t i = 0; whole && i < offsets->count; ++i) {
    const auto at = page.number(is_tiled ? kTileOffsets : kStripOffsets, i);
    const auto length = page.number(lengths, i);
    whole = at && length && std::uint64_t{*at} + *length <= bytes.size();
    sum += length.value_or(0);
  }
  if (page.number(kCompression).value_or(1) == 1) whole = whole && sum >= plainBytes(page);
  if (!whole) throw Error::inFile(name, "is cut off, with part of the picture missing; copy the file again");
}

}  // namespace

PictureHeader readTiffHeader(std::string_view bytes, std::string_view name) {
  const auto start = tiffStart(bytes);
  const TiffDirectory page(bytes, start->big_endian, start->directory_at);
  if (page.empty()) throw Error::inFile(name, "is cut off, a TIFF without its page; copy the file again");
  refuseRaw(page, bytes, name);
  PictureHeader header{.format = PictureFormat::tiff};
  header.width_px = page.number(kWidth).value_or(0);
  header.height_px = page.number(kHeight).value_or(0);
  checkColours(page, header, name);
  checkPictureSize(header, name);
  checkDataInFile(page, bytes, name);
  header.pages = page.next() != 0 ? 2 : 1;
  header.exif = readExif(page, bytes, start->big_endian);
  if (const TiffTag* orientation = page.find(kOrientation)) {
    header.orientation_at = orientation->value_at;
    header.orientation_big_endian = start->big_endian;
  }
  return header;
}

}  // namespace palpate::measure
