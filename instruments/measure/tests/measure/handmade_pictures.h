// Pictures as bytes, made by hand where the writer of a library would not make them: EXIF blocks, TIFF files with any
// tags, PNG chunks.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace palpate::measure {

/// Red, green over blue, white: the four quarters. Blue, green, red as OpenCV has them.
inline cv::Mat testCard(int width = 300, int height = 220) {
  cv::Mat card(height, width, CV_8UC3, cv::Scalar(255, 255, 255));
  const int half_width = width / 2;
  const int half_height = height / 2;
  card(cv::Rect(0, 0, half_width, half_height)) = cv::Scalar(0, 0, 255);
  card(cv::Rect(half_width, 0, width - half_width, half_height)) = cv::Scalar(0, 255, 0);
  card(cv::Rect(0, half_height, half_width, height - half_height)) = cv::Scalar(255, 0, 0);
  return card;
}

inline std::string coded(const cv::Mat& picture, const std::string& extension, const std::vector<int>& settings = {}) {
  std::vector<uchar> bytes;
  cv::imencode(extension, picture, bytes, settings);
  return {bytes.begin(), bytes.end()};
}

inline std::span<const std::byte> bytesOf(std::string_view text) { return std::as_bytes(std::span(text)); }

inline std::string number(std::uint32_t value, int width, bool big_endian) {
  std::string bytes;
  for (int i = 0; i < width; ++i) {
    const int shift = 8 * (big_endian ? width - 1 - i : i);
    bytes += static_cast<char>(value >> shift & 0xffU);
  }
  return bytes;
}

/// One tag with its values as bytes.
struct HandmadeTag {
  std::uint16_t tag;
  std::uint16_t type;
  std::uint32_t count;
  std::string value;
};

inline HandmadeTag shortTag(std::uint16_t tag, std::uint16_t value, bool big_endian) {
  return {tag, 3, 1, number(value, 2, big_endian)};
}
inline HandmadeTag longTag(std::uint16_t tag, std::uint32_t value, bool big_endian) {
  return {tag, 4, 1, number(value, 4, big_endian)};
}
inline HandmadeTag textTag(std::uint16_t tag, const std::string& text) {
  return {tag, 2, static_cast<std::uint32_t>(text.size() + 1), text + '\0'};
}

/// A directory that is to stand at `at`, its long values behind it.
inline std::string directory(const std::vector<HandmadeTag>& tags, std::size_t at, bool big_endian,
                             std::uint32_t next = 0) {
  std::string head = number(static_cast<std::uint32_t>(tags.size()), 2, big_endian);
  std::string values;
  const std::size_t values_at = at + 2 + 12 * tags.size() + 4;
  for (const HandmadeTag& tag : tags) {
    head += number(tag.tag, 2, big_endian) + number(tag.type, 2, big_endian) + number(tag.count, 4, big_endian);
    if (tag.value.size() <= 4) {
      head += tag.value + std::string(4 - tag.value.size(), '\0');
    } else {
      head += number(static_cast<std::uint32_t>(values_at + values.size()), 4, big_endian);
      values += tag.value;
    }
  }
  return head + number(next, 4, big_endian) + values;
}

inline std::string tiffStartBytes(bool big_endian, std::uint32_t directory_at = 8) {
  return (big_endian ? std::string("MM\0*", 4) : std::string("II*\0", 4)) + number(directory_at, 4, big_endian);
}

struct HandmadeExif {
  bool big_endian = true;
  int orientation = 1;
  std::string made = {};       ///< DateTime
  std::string original = {};   ///< DateTimeOriginal
  std::string fractions = {};  ///< SubSecTimeOriginal
};

inline std::string exifBytes(const HandmadeExif& exif) {
  const bool big = exif.big_endian;
  std::vector<HandmadeTag> first = {shortTag(0x0112, static_cast<std::uint16_t>(exif.orientation), big)};
  if (!exif.made.empty()) first.push_back(textTag(0x0132, exif.made));
  const std::string without = directory(first, 8, big);
  first.push_back(longTag(0x8769, static_cast<std::uint32_t>(8 + without.size() + 12), big));
  std::vector<HandmadeTag> details;
  if (!exif.original.empty()) details.push_back(textTag(0x9003, exif.original));
  if (!exif.fractions.empty()) details.push_back(textTag(0x9291, exif.fractions));
  return tiffStartBytes(big) + directory(first, 8, big) + directory(details, 8 + without.size() + 12, big);
}

inline std::string withExif(const std::string& jpeg, const std::string& block) {
  const std::string segment = std::string("Exif\0\0", 6) + block;
  return jpeg.substr(0, 2) + "\xff\xe1" + number(static_cast<std::uint32_t>(segment.size() + 2), 2, true) + segment +
         jpeg.substr(2);
}

/// Behind the first chunk.
inline std::string withChunk(const std::string& png, const std::string& kind, const std::string& data) {
  const std::string checked = kind + data;
  const auto sum = crc32(0, reinterpret_cast<const Bytef*>(checked.data()), static_cast<uInt>(checked.size()));
  return png.substr(0, 33) + number(static_cast<std::uint32_t>(data.size()), 4, true) + checked +
         number(static_cast<std::uint32_t>(sum), 4, true) + png.substr(33);
}

struct HandmadeTiff {
  bool big_endian = false;
  int width = 300;
  int height = 220;
  int bits = 8;
  int samples = 3;
  int photometric = 2;  ///< RGB
  int extra_samples = -1;
  int sample_format = -1;
  int orientation = 1;
  bool has_second_page = false;
  std::vector<HandmadeTag> further = {};
  std::string pixels = {};  ///< row by row
};

/// Without compression, in one strip.
inline std::string tiffBytes(const HandmadeTiff& tiff) {
  const bool big = tiff.big_endian;
  const auto shorts = [&](std::uint16_t tag, int value, int count) {
    HandmadeTag made{tag, 3, static_cast<std::uint32_t>(count), {}};
    for (int i = 0; i < count; ++i) made.value += number(static_cast<std::uint32_t>(value), 2, big);
    return made;
  };
  std::vector<HandmadeTag> tags = {
      longTag(256, static_cast<std::uint32_t>(tiff.width), big),
      longTag(257, static_cast<std::uint32_t>(tiff.height), big),
      shorts(258, tiff.bits, tiff.samples),
      shorts(259, 1, 1),
      shorts(262, tiff.photometric, 1),
      longTag(273, 8, big),
      shorts(274, tiff.orientation, 1),
      shorts(277, tiff.samples, 1),
      longTag(278, static_cast<std::uint32_t>(tiff.height), big),
      longTag(279, static_cast<std::uint32_t>(tiff.pixels.size()), big),
  };
  if (tiff.extra_samples >= 0) tags.push_back(shorts(338, tiff.extra_samples, 1));
  if (tiff.sample_format >= 0) tags.push_back(shorts(339, tiff.sample_format, tiff.samples));
  tags.insert(tags.end(), tiff.further.begin(), tiff.further.end());
  const std::string padding(tiff.pixels.size() % 2, '\0');
  const auto at = static_cast<std::uint32_t>(8 + tiff.pixels.size() + padding.size());
  const std::string page = directory(tags, at, big);
  const auto second_at = static_cast<std::uint32_t>(at + page.size());
  std::string bytes = tiffStartBytes(big, at) + tiff.pixels + padding;
  if (!tiff.has_second_page) return bytes + page;
  return bytes + directory(tags, at, big, second_at) + directory(tags, second_at, big);
}

/// The test card as its rows of red, green, blue, and what more there is to a pixel.
inline std::string cardPixels(const std::string& more = {}, int width = 300, int height = 220) {
  const cv::Mat card = testCard(width, height);
  std::string pixels;
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const auto& pixel = card.at<cv::Vec3b>(row, column);
      pixels += {static_cast<char>(pixel[2]), static_cast<char>(pixel[1]), static_cast<char>(pixel[0])};
      pixels += more;
    }
  }
  return pixels;
}

}  // namespace palpate::measure
