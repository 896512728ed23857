// Photographs by OpenCV's decoders, which see only what picture_header.h let pass. They must not turn the picture: how
// a picture was held is read once, for all formats, and applied here.
//
//   file ─ readPictureHeader ─► cv::imdecode ─► over white, 8 bits ─► turned ─► Photograph
//
// Peak memory for N megapixels: 3 N MB for the picture, 3 N more while it is decoded or turned; 8 N more for 16 bits
// with transparency, 6 N more for a progressive JPEG.
#include "palpate/measure/photograph.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/text.h"
#include "palpate/measure/pictures/picture_header.h"

namespace palpate::measure {

namespace {

/// More than the largest picture that is taken needs without any compression.
constexpr std::uint64_t kMaxBytes = 450'000'000;
constexpr int kUsualQuality = 90;

/// OpenCV prints to the standard error what becomes an Error here.
class QuietOpenCv {
 public:
  QuietOpenCv() : before_(cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT)) {}
  ~QuietOpenCv() { cv::utils::logging::setLogLevel(before_); }
  QuietOpenCv(const QuietOpenCv&) = delete;
  QuietOpenCv& operator=(const QuietOpenCv&) = delete;

 private:
  cv::utils::logging::LogLevel before_;
};

/// The numbers 2 to 8 as EXIF counts them: mirrored, turned, or both.
cv::Mat turned(const cv::Mat& stored, int orientation) {
  cv::Mat upright = stored;
  if (orientation >= 5) cv::transpose(stored, upright);
  // 5 is the transposed picture itself.
  if (orientation == 2 || orientation == 6) cv::flip(upright, upright, 1);
  if (orientation == 3 || orientation == 7) cv::flip(upright, upright, -1);
  if (orientation == 4 || orientation == 8) cv::flip(upright, upright, 0);
  return upright;
}

cv::Mat withEightBits(const cv::Mat& picture) {
  if (picture.depth() == CV_8U) return picture;
  cv::Mat reduced;
  picture.convertTo(reduced, CV_8U, 255.0 / 65535.0);
  return reduced;
}

/// Blends four channels over white, to three.
cv::Mat overWhite(const cv::Mat& picture, bool is_multiplied) {
  cv::Mat laid(picture.size(), CV_8UC3);
  for (int row = 0; row < picture.rows; ++row) {
    const auto* from = picture.ptr<cv::Vec4b>(row);
    auto* to = laid.ptr<cv::Vec3b>(row);
    for (int column = 0; column < picture.cols; ++column) {
      const int alpha = from[column][3];
      for (int channel = 0; channel < 3; ++channel) {
        const int own = is_multiplied ? from[column][channel] * 255 : from[column][channel] * alpha;
        to[column][channel] = cv::saturate_cast<uchar>((own + 255 * (255 - alpha) + 127) / 255);
      }
    }
  }
  return laid;
}

/// Blue, green, red of eight bits, as stored.
cv::Mat decode(const cv::Mat& coded, const PictureHeader& header, std::string_view name) {
  const QuietOpenCv quiet;
  // Only "unchanged" keeps the transparency.
  const int mode = header.is_transparent ? cv::IMREAD_UNCHANGED : cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION;
  cv::Mat picture;
  try {
    picture = withEightBits(cv::imdecode(coded, mode));
  } catch (const cv::Exception& trouble) {
    if (trouble.code == cv::Error::StsNoMem) throw std::bad_alloc();
  }
  if (picture.empty() || static_cast<std::size_t>(picture.cols) != header.width_px ||
      static_cast<std::size_t>(picture.rows) != header.height_px) {
    throw Error::inFile(name, "is damaged and cannot be decoded; copy the file again, or save it as JPEG or PNG");
  }
  // libtiff has multiplied the colours of eight bits in any case.
  const bool is_multiplied = header.is_multiplied || (header.format == PictureFormat::tiff && header.bits == 8);
  if (picture.channels() == 4) picture = overWhite(picture, is_multiplied);
  if (picture.channels() == 1) cv::cvtColor(picture, picture, cv::COLOR_GRAY2BGR);
  return picture;
}

std::vector<std::string> notesOn(const PictureHeader& header) {
  std::vector<std::string> notes;
  if (header.bits == 16) notes.emplace_back("16 bits a channel, reduced to 8");
  if (header.is_transparent) notes.emplace_back("transparency, laid over white");
  if (header.pages > 1) notes.emplace_back("several pages, of which the first is used");
  return notes;
}

Photograph makePhotograph(const cv::Mat& bgr, std::string_view name, const PictureHeader& header) {
  Photograph photograph{.name = std::string(name), .width_px = bgr.cols, .height_px = bgr.rows};
  photograph.rgb.resize(bgr.total() * 3);
  cv::Mat rgb(bgr.size(), CV_8UC3, photograph.rgb.data());
  cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
  photograph.taken_at_s = header.exif.taken_at_s;
  photograph.notes = notesOn(header);
  return photograph;
}

/// `bytes` may be changed: a TIFF's decoder reads how it was held by itself.
Photograph decodeOwned(std::string& bytes, std::string_view name) {
  const PictureHeader header = readPictureHeader(bytes, name);
  if (header.orientation_at != 0) {
    bytes[header.orientation_at] = header.orientation_big_endian ? '\0' : '\1';
    bytes[header.orientation_at + 1] = header.orientation_big_endian ? '\1' : '\0';
  }
  const cv::Mat coded(1, static_cast<int>(bytes.size()), CV_8UC1, bytes.data());
  return makePhotograph(turned(decode(coded, header, name), header.exif.orientation), name, header);
}

/// Throws Error where size and pixels do not fit.
cv::Mat asCvMat(const Photograph& picture) {
  if (picture.width_px <= 0 || picture.height_px <= 0 ||
      picture.rgb.size() !=
          std::size_t{3} * static_cast<std::size_t>(picture.width_px) * static_cast<std::size_t>(picture.height_px)) {
    throw Error("a picture's size does not match its pixels");
  }
  // OpenCV takes no pointer to const data; it does not change them.
  return {picture.height_px, picture.width_px, CV_8UC3, const_cast<std::uint8_t*>(picture.rgb.data())};
}

std::string encoded(const Photograph& picture, const char* extension, const std::vector<int>& settings) {
  cv::Mat bgr;
  cv::cvtColor(asCvMat(picture), bgr, cv::COLOR_RGB2BGR);
  std::vector<uchar> bytes;
  if (!cv::imencode(extension, bgr, bytes, settings)) throw Error("a picture cannot be encoded");
  return {bytes.begin(), bytes.end()};
}

std::string bigEndian(std::size_t number, int width) {
  std::string bytes;
  for (int i = width - 1; i >= 0; --i) bytes += static_cast<char>(number >> (8 * i) & 0xffU);
  return bytes;
}

void writePng(const std::filesystem::path& file, const Photograph& picture) {
  constexpr std::size_t kAfterHeader = 8 + 25;  // signature and first chunk
  std::string bytes = encoded(picture, ".png", {});
  if (picture.taken_at_s) {
    const std::string chunk = "eXIf" + exifBlock(*picture.taken_at_s);
    const auto sum = crc32_z(0, reinterpret_cast<const Bytef*>(chunk.data()), chunk.size());
    bytes.insert(kAfterHeader, bigEndian(chunk.size() - 4, 4) + chunk + bigEndian(sum, 4));
  }
  writeFile(file, bytes);
}

}  // namespace

Photograph readPhotograph(const std::filesystem::path& file) {
  std::string bytes = readFile(file, kMaxBytes);
  return decodeOwned(bytes, file.string());
}

Photograph decodePhotograph(std::span<const std::byte> bytes, std::string_view name) {
  if (bytes.size() > kMaxBytes) throw Error::inFile(name, "is too large for a photograph; make it smaller");
  std::string owned(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return decodeOwned(owned, name);
}

Photograph reducedTo(const Photograph& picture, int width_px) {
  if (width_px <= 0 || width_px >= picture.width_px) return picture;
  const double share = static_cast<double>(width_px) / picture.width_px;
  Photograph reduced{
      .name = picture.name, .width_px = width_px, .taken_at_s = picture.taken_at_s, .notes = picture.notes};
  reduced.height_px = std::max(1, static_cast<int>(std::lround(share * picture.height_px)));
  reduced.rgb.resize(std::size_t{3} * static_cast<std::size_t>(width_px) * static_cast<std::size_t>(reduced.height_px));
  cv::Mat to(reduced.height_px, width_px, CV_8UC3, reduced.rgb.data());
  cv::resize(asCvMat(picture), to, to.size(), 0.0, 0.0, cv::INTER_AREA);
  return reduced;
}

void writeJpeg(const std::filesystem::path& file, const Photograph& picture, int quality) {
  std::string bytes = encoded(picture, ".jpg", {cv::IMWRITE_JPEG_QUALITY, std::clamp(quality, 1, 100)});
  if (picture.taken_at_s) {
    const std::string segment = std::string("Exif\0\0", 6) + exifBlock(*picture.taken_at_s);
    bytes.insert(2, "\xff\xe1" + bigEndian(segment.size() + 2, 2) + segment);  // behind the mark of the start
  }
  writeFile(file, bytes);
}

void writePhotograph(const std::filesystem::path& file, const Photograph& picture) {
  const std::string extension = file.extension().string();
  if (extension == ".png") return writePng(file, picture);
  if (extension == ".jpg" || extension == ".jpeg") return writeJpeg(file, picture, kUsualQuality);
  throw Error::inFile(file.string(), "a photograph's name must end in .png or .jpg");
}

}  // namespace palpate::measure
