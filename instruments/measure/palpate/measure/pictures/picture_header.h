// Reads the first bytes of a picture before memory is allocated for it: its kind, its size, and whether it can be used.
// One file per format; unusable files are refused here, by name.
#pragma once

#include <cstddef>
#include <string_view>

#include "palpate/measure/pictures/exif.h"

namespace palpate::measure {

enum class PictureFormat : unsigned char { jpeg, png, tiff };

struct PictureHeader {
  PictureFormat format = PictureFormat::jpeg;
  std::size_t width_px = 0;  ///< as stored, before it is turned
  std::size_t height_px = 0;
  std::size_t bits = 8;  ///< a channel
  bool is_transparent = false;
  bool is_multiplied = false;  ///< its transparency is in the colours already
  std::size_t pages = 1;       ///< 2: more than one
  Exif exif = {};
  std::size_t orientation_at = 0;  ///< TIFF: offset of its number, for the decoder must not turn the picture too
  bool orientation_big_endian = false;
};

/// Throws Error naming the file for anything but a whole JPEG, PNG or TIFF of a size that is taken. Reads the whole
/// file but decodes nothing.
PictureHeader readPictureHeader(std::string_view bytes, std::string_view name);

// One per format.
PictureHeader readJpegHeader(std::string_view bytes, std::string_view name);
PictureHeader readPngHeader(std::string_view bytes, std::string_view name);
PictureHeader readTiffHeader(std::string_view bytes, std::string_view name);

/// Throws Error for a size that is not taken.
void checkPictureSize(const PictureHeader& header, std::string_view name);

/// Names a foreign format and the remedy: "is a WebP picture: save it as JPEG, PNG or TIFF".
std::string_view foreignPicture(std::string_view bytes);

}  // namespace palpate::measure
