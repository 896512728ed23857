// Based on: CIPA DC-008 (EXIF 2.32), sections 4.6.4 (orientation, DateTime) and 4.6.5 (DateTimeOriginal, fractions).
#include "palpate/measure/pictures/exif.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>

#include "palpate/base/text.h"

namespace palpate::measure {

namespace {

enum : std::uint16_t {
  kOrientationTag = 0x0112,
  kDateTime = 0x0132,
  kExifDirectory = 0x8769,
  kDateTimeOriginal = 0x9003,
  kFractions = 0x9290,
  kFractionsOriginal = 0x9291,
};

/// "2024:05:17 10:20:30" is 19 letters long.
constexpr std::string_view kForm = "0000:00:00 00:00:00";

std::optional<int> digits(std::string_view text) {
  int number = 0;
  for (const char letter : text) {
    if (letter < '0' || letter > '9') return std::nullopt;
    number = 10 * number + (letter - '0');
  }
  return number;
}

bool hasForm(std::string_view text) {
  if (text.size() < kForm.size()) return false;
  return std::equal(kForm.begin(), kForm.end(), text.begin(), [](char form, char letter) {
    return form == '0' ? letter >= '0' && letter <= '9' : form == letter;
  });
}

std::optional<double> parseDateTime(std::string_view text, std::string_view fractions) {
  using namespace std::chrono;
  if (!hasForm(text)) return std::nullopt;
  const auto part = [&](std::size_t at, std::size_t count) { return *digits(text.substr(at, count)); };
  const year_month_day date(year(part(0, 4)), month(static_cast<unsigned>(part(5, 2))),
                            day(static_cast<unsigned>(part(8, 2))));
  const int hour = part(11, 2);
  const int minute = part(14, 2);
  const int second = part(17, 2);
  if (!date.ok() || hour > 23 || minute > 59 || second > 60) return std::nullopt;  // 60: a leap second
  double seconds = 86400.0 * static_cast<double>(sys_days(date).time_since_epoch().count());
  seconds += 3600.0 * hour + 60.0 * minute + second;
  const std::string_view decimals = trimmed(fractions).substr(0, 9);
  if (const auto number = digits(decimals); number && !decimals.empty()) {
    seconds += *number * std::pow(10.0, -static_cast<double>(decimals.size()));
  }
  return seconds;
}

std::string little(std::uint32_t number, int width) {
  std::string bytes;
  for (int i = 0; i < width; ++i) bytes += static_cast<char>(number >> (8 * i) & 0xffU);
  return bytes;
}

std::string tagBytes(std::uint16_t tag, std::uint16_t type, std::uint32_t count, const std::string& value) {
  return little(tag, 2) + little(type, 2) + little(count, 4) + value;
}

std::string wordsOf(double seconds) {
  using namespace std::chrono;
  const auto whole = static_cast<std::int64_t>(seconds);
  const year_month_day date{sys_days(days(static_cast<int>(whole / 86400)))};
  const auto rest = whole % 86400;
  return fmt::format("{:04}:{:02}:{:02} {:02}:{:02}:{:02}", static_cast<int>(date.year()),
                     static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()), rest / 3600,
                     rest / 60 % 60, rest % 60);
}

}  // namespace

Exif readExif(const TiffDirectory& first, std::string_view block, bool big_endian) {
  Exif exif;
  const std::uint32_t orientation = first.number(kOrientationTag).value_or(1);
  if (orientation >= 1 && orientation <= 8) exif.orientation = static_cast<int>(orientation);
  const TiffDirectory details(block, big_endian, first.number(kExifDirectory).value_or(0));
  exif.taken_at_s = parseDateTime(details.text(kDateTimeOriginal), details.text(kFractionsOriginal));
  if (!exif.taken_at_s) exif.taken_at_s = parseDateTime(first.text(kDateTime), details.text(kFractions));
  return exif;
}

Exif readExif(std::string_view block) {
  const auto start = tiffStart(block);
  if (!start) return {};
  return readExif(TiffDirectory(block, start->big_endian, start->directory_at), block, start->big_endian);
}

std::string exifBlock(double taken_at_s) {
  // Milliseconds are what cameras write at most.
  const double rounded = std::round(std::clamp(taken_at_s, 0.0, 253402300799.0) * 1000.0) / 1000.0;
  const std::string time = wordsOf(rounded) + '\0';
  const std::string fractions = fmt::format("{:03}", std::lround((rounded - std::floor(rounded)) * 1000.0)) + '\0';
  // The start, a directory of two tags, one of two, and the text that fits into neither.
  constexpr std::uint32_t kDetailsAt = 8 + 2 + 2 * 12 + 4;
  constexpr std::uint32_t kTextAt = kDetailsAt + 2 + 2 * 12 + 4;
  const auto letters = static_cast<std::uint32_t>(time.size());
  std::string block = std::string("II*\0", 4) + little(8, 4);
  block += little(2, 2) + tagBytes(kOrientationTag, 3, 1, little(1, 4)) +
           tagBytes(kExifDirectory, 4, 1, little(kDetailsAt, 4));
  block += little(0, 4);
  block += little(2, 2) + tagBytes(kDateTimeOriginal, 2, letters, little(kTextAt, 4)) +
           tagBytes(kFractionsOriginal, 2, static_cast<std::uint32_t>(fractions.size()), fractions);
  return block + little(0, 4) + time;
}

}  // namespace palpate::measure
