// A photograph as the room `measure` reads it: upright, eight bits a channel, with the time it was taken, if noted.
//
//   file ─ readPhotograph ─► Photograph ─► findDots (dots.h)
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace palpate::measure {

/// Pictures larger than this are refused before anything is decoded: 48 megapixels and some rim.
inline constexpr std::int64_t kMaxPixels = 52'000'000;

struct Photograph {
  std::string name;  ///< as it was named to the reader
  int width_px = 0;
  int height_px = 0;
  /// Row by row from the top left, red, green, blue; 3 * width * height bytes. Turned by EXIF's orientation.
  std::vector<std::uint8_t> rgb = {};
  /// EXIF's time of taking in seconds since 1970 as if its clock were UTC, with its fractions; only differences between
  /// two pictures of one camera mean something.
  std::optional<double> taken_at_s = {};
  /// Conversions made to read it, for people: "16 bits a channel, reduced to 8". Empty: none.
  std::vector<std::string> notes = {};
};

/// JPEG, PNG or TIFF, by content and not by name. 16 bits a channel are reduced, grey becomes three equal channels,
/// transparency is laid over white, of several pages the first is taken (with a note). Throws Error naming the file for
/// a file of another format, truncated, animated, in CMYK, larger than kMaxPixels, or smaller than 200 x 200 pixels.
Photograph readPhotograph(const std::filesystem::path& file);
Photograph decodePhotograph(std::span<const std::byte> bytes, std::string_view name);

/// The same picture with fewer pixels, each the mean of those that it replaces; unchanged if it is at most this wide.
Photograph reducedTo(const Photograph& picture, int width_px);

/// Writes PNG or JPEG (quality 90), by the name's extension; through the one checked writer. Throws Error.
void writePhotograph(const std::filesystem::path& file, const Photograph& picture);
/// The same with a time of taking, as cameras write it into JPEG (EXIF DateTimeOriginal); `quality` 1 to 100.
void writeJpeg(const std::filesystem::path& file, const Photograph& picture, int quality);

}  // namespace palpate::measure
