// A camera's notes in a picture (EXIF): how it was held, and when. Read from hostile bytes, and written as cameras
// write it into JPEG.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "palpate/measure/pictures/tiff_tags.h"

namespace palpate::measure {

struct Exif {
  /// How the stored picture must be turned: 1 (not at all) to 8, as the tag counts.
  int orientation = 1;
  /// Seconds since 1970 by the camera's clock; when it was taken, else the file's own time.
  std::optional<double> taken_at_s = {};
};

/// From a block that starts as a TIFF file does. What cannot be read is as if it were not there.
Exif readExif(std::string_view block);
Exif readExif(const TiffDirectory& first, std::string_view block, bool big_endian);

/// The block with this time and an upright picture.
std::string exifBlock(double taken_at_s);

}  // namespace palpate::measure
