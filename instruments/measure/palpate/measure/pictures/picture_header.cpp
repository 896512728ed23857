// The formats by their first bytes; the name of a file does not matter.
#include "palpate/measure/pictures/picture_header.h"

#include <fmt/format.h>

#include "palpate/base/error.h"
#include "palpate/base/number_range.h"
#include "palpate/measure/photograph.h"

namespace palpate::measure {

namespace {

constexpr std::size_t kMinSide = 200;

}  // namespace

void checkPictureSize(const PictureHeader& header, std::string_view name) {
  const double pixels = static_cast<double>(header.width_px) * static_cast<double>(header.height_px);
  if (pixels > static_cast<double>(kMaxPixels)) {
    throw Error::inFile(
        name,
        fmt::format("{} x {} pixels is more than the maximum of {} million; make it smaller, 2 megapixels are enough",
                    header.width_px, header.height_px, kMaxPixels / 1'000'000));
  }
  if (header.width_px < kMinSide || header.height_px < kMinSide) {
    throw Error::inFile(name, fmt::format("{} x {} pixels is too small to find dots in; at least {} x {} are needed",
                                          header.width_px, header.height_px, kMinSide, kMinSide));
  }
}

PictureHeader readPictureHeader(std::string_view bytes, std::string_view name) {
  PictureHeader header;
  if (bytes.starts_with("\xff\xd8\xff")) {
    header = readJpegHeader(bytes, name);
  } else if (bytes.starts_with("\x89PNG\r\n\x1a\n")) {
    header = readPngHeader(bytes, name);
  } else if (tiffStart(bytes)) {
    header = readTiffHeader(bytes, name);
  } else {
    throw Error::inFile(name, foreignPicture(bytes));
  }
  checkPictureSize(header, name);
  return header;
}

}  // namespace palpate::measure
