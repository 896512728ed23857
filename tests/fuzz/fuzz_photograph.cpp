// Any bytes as a photograph: its header read, its EXIF block too, and what is small enough decoded; a picture or one
// Error.
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "palpate/base/error.h"
#include "palpate/measure/photograph.h"
#include "palpate/measure/pictures/exif.h"
#include "palpate/measure/pictures/picture_header.h"

namespace {

/// Larger ones pass through the same code, only longer.
constexpr std::size_t kMaxPixels = 300'000;

void decode(std::string_view bytes) {
  using namespace palpate::measure;
  const PictureHeader header = readPictureHeader(bytes, "fuzz");
  if (header.width_px * header.height_px > kMaxPixels) return;
  const Photograph picture = decodePhotograph(std::as_bytes(std::span(bytes)), "fuzz");
  const auto pixels = static_cast<std::size_t>(picture.width_px) * static_cast<std::size_t>(picture.height_px);
  if (picture.rgb.size() != 3 * pixels || pixels == 0) __builtin_trap();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const palpate::measure::Exif exif = palpate::measure::readExif(bytes);
  if (exif.orientation < 1 || exif.orientation > 8) __builtin_trap();
  try {
    decode(bytes);
  } catch (const palpate::Error& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) __builtin_trap();
  }
  return 0;
}
