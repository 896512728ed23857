#include "cli/kit/readable_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "palpate/base/text.h"

namespace palpate::app {

namespace {

constexpr std::string_view kReplacement = "\xef\xbf\xbd";  // U+FFFD

/// Changes the direction of the following text: names that look like others.
bool turnsText(std::uint32_t letter) {
  return (letter >= 0x202a && letter <= 0x202e) || (letter >= 0x2066 && letter <= 0x2069);
}

/// Allowed in XML 1.0 and without effect on terminals: no controls of ASCII and Latin 1.
bool isAllowedCharacter(std::uint32_t letter) {
  if (letter < 0x20) return letter == '\t' || letter == '\n';
  if ((letter >= 0x7f && letter < 0xa0) || turnsText(letter)) return false;
  return letter != 0xfffe && letter != 0xffff;
}

/// Decodes the bytes of one letter.
std::uint32_t decodeCodePoint(std::string_view bytes) {
  const auto first = static_cast<unsigned char>(bytes.front());
  std::uint32_t letter = bytes.size() == 1 ? first : first & (0x7fu >> bytes.size());
  for (const char next : bytes.substr(1)) letter = (letter << 6) | (static_cast<unsigned char>(next) & 0x3fu);
  return letter;
}

}  // namespace

std::string readableText(std::string_view text) {
  std::string readable;
  while (!text.empty()) {
    const std::size_t bytes = letterBytes(text);
    const bool stands = bytes > 0 && isAllowedCharacter(decodeCodePoint(text.substr(0, bytes)));
    readable += stands ? text.substr(0, bytes) : kReplacement;
    text.remove_prefix(stands ? bytes : 1);
  }
  return readable;
}

std::string readableLine(std::string_view text) {
  std::string line = readableText(text);
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == '\n' || c == '\t'; }, ' ');
  return line;
}

void printReadable(std::string_view text) { fmt::print("{}", readableText(text)); }

}  // namespace palpate::app
