// Walks over the segments of a JPEG to its end: a file that was cut off has none, and the decoder would only fill it up
// with grey.
// Based on: ITU-T T.81, annex B.
#include <fmt/format.h>

#include <algorithm>

#include "palpate/base/error.h"
#include "palpate/measure/pictures/picture_header.h"

namespace palpate::measure {

namespace {

constexpr std::string_view kTruncated = "is cut off: the end of the picture is missing; copy the file again";
/// A camera's has 1 or about 10. Each of a few bytes costs as much as decoding the whole picture.
constexpr int kMaxScans = 64;
constexpr std::string_view kDamaged = "is damaged: a marker is missing; copy the file again";

class Segments {
 public:
  Segments(std::string_view bytes, std::string_view name) : bytes_(bytes), name_(name) {}

  PictureHeader walk() {
    for (int marker = nextMarker(); marker != 0xd9; marker = nextMarker()) {
      const bool stands_alone = marker == 0x01 || (marker >= 0xd0 && marker <= 0xd8);
      if (stands_alone) continue;
      const std::string_view segment = readSegment();
      if (isFrame(marker)) readFrame(segment);
      if (marker == 0xe1) readApplication(segment);
      if (marker == 0xda) skipScan();
    }
    if (!has_frame_ || scans_ == 0) throw Error::inFile(name_, "is a JPEG without a picture; copy the file again");
    return header_;
  }

 private:
  /// Tables (c4), extensions (c8) and conditions of arithmetic coding (cc) lie among the frames.
  static bool isFrame(int marker) {
    return marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
  }
  unsigned byteAt(std::size_t at) const { return static_cast<unsigned char>(bytes_[at]); }

  int nextMarker() {
    if (at_ + 2 > bytes_.size()) throw Error::inFile(name_, kTruncated);
    if (byteAt(at_) != 0xff) throw Error::inFile(name_, kDamaged);
    while (at_ < bytes_.size() && byteAt(at_) == 0xff) ++at_;  // any number of them may come before a marker
    if (at_ == bytes_.size()) throw Error::inFile(name_, kTruncated);
    return static_cast<int>(byteAt(at_++));
  }

  std::string_view readSegment() {
    if (at_ + 2 > bytes_.size()) throw Error::inFile(name_, kTruncated);
    const std::size_t length = byteAt(at_) * std::size_t{256} + byteAt(at_ + 1);
    if (length < 2) throw Error::inFile(name_, kDamaged);
    if (at_ + length > bytes_.size()) throw Error::inFile(name_, kTruncated);
    const std::string_view segment = bytes_.substr(at_ + 2, length - 2);
    at_ += length;
    return segment;
  }

  void readFrame(std::string_view segment) {
    if (segment.size() < 6) throw Error::inFile(name_, kDamaged);
    if (has_frame_) throw Error::inFile(name_, "is a JPEG in layers; save it as a plain JPEG, PNG or TIFF");
    has_frame_ = true;
    const auto number = [&](std::size_t at) {
      return static_cast<std::size_t>(static_cast<unsigned char>(segment[at]));
    };
    if (number(0) != 8) throw Error::inFile(name_, fmt::format("is a JPEG of {} bits; save it with 8", number(0)));
    header_.height_px = number(1) * 256 + number(2);
    header_.width_px = number(3) * 256 + number(4);
    if (number(5) == 4) {
      throw Error::inFile(name_, "is a JPEG in print colours (CMYK); save it in RGB, as cameras do");
    }
    if (number(5) != 1 && number(5) != 3)
      throw Error::inFile(name_, "has an unsupported JPEG colour space; save it in RGB");
  }

  void readApplication(std::string_view segment) {
    constexpr std::string_view kExif("Exif\0\0", 6);
    if (has_exif_ || !segment.starts_with(kExif)) return;
    has_exif_ = true;
    header_.exif = readExif(segment.substr(kExif.size()));
  }

  /// To the next marker that is neither a byte of data nor a restart.
  void skipScan() {
    if (!has_frame_) throw Error::inFile(name_, kDamaged);
    if (++scans_ > kMaxScans) {
      throw Error::inFile(name_, fmt::format("is a JPEG in more than {} layers; save it again", kMaxScans));
    }
    for (;;) {
      at_ = bytes_.find('\xff', at_);
      if (at_ == std::string_view::npos || at_ + 1 >= bytes_.size()) throw Error::inFile(name_, kTruncated);
      const unsigned following = byteAt(at_ + 1);
      const bool is_data = following == 0 || (following >= 0xd0 && following <= 0xd7);
      if (!is_data && following != 0xff) return;
      at_ += is_data ? 2 : 1;
    }
  }

  std::string_view bytes_;
  std::string_view name_;
  std::size_t at_ = 0;
  PictureHeader header_;
  bool has_frame_ = false;
  int scans_ = 0;
  bool has_exif_ = false;
};

}  // namespace

PictureHeader readJpegHeader(std::string_view bytes, std::string_view name) { return Segments(bytes, name).walk(); }

}  // namespace palpate::measure
