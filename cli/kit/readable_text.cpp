// UTF-8 as RFC 3629 has it: no overlong forms, no surrogates, nothing beyond U+10FFFF.
#include "cli/kit/readable_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace palpate::app {

namespace {

constexpr std::string_view kReplacement = "\xef\xbf\xbd";  // U+FFFD

std::uint32_t byteAt(std::string_view text, std::size_t at) { return static_cast<unsigned char>(text[at]); }

/// How many bytes follow a first byte; -1 for what is none.
int followersOf(std::uint32_t first) {
  if (first < 0x80) return 0;
  if (first >= 0xc2 && first < 0xe0) return 1;
  if (first >= 0xe0 && first < 0xf0) return 2;
  return first >= 0xf0 && first < 0xf5 ? 3 : -1;
}

/// Makes what follows stand in another order than it has: names that look like others.
bool turnsText(std::uint32_t letter) {
  return (letter >= 0x202a && letter <= 0x202e) || (letter >= 0x2066 && letter <= 0x2069);
}

/// What XML 1.0 lets stand in a document, and no terminal acts on: without the controls of ASCII and of Latin 1.
bool mayStand(std::uint32_t letter, int followers) {
  constexpr std::uint32_t kMin[] = {0, 0x80, 0x800, 0x10000};
  if (letter < kMin[followers] || letter > 0x10ffff) return false;
  if (letter < 0x20) return letter == '\t' || letter == '\n';
  if ((letter >= 0x7f && letter < 0xa0) || turnsText(letter)) return false;
  return !(letter >= 0xd800 && letter < 0xe000) && letter != 0xfffe && letter != 0xffff;
}

/// The bytes of the letter that begins here; 0 where none does.
std::size_t letterAt(std::string_view text, std::size_t at) {
  const int followers = followersOf(byteAt(text, at));
  if (followers < 0 || at + static_cast<std::size_t>(followers) >= text.size()) return 0;
  std::uint32_t letter = followers == 0 ? byteAt(text, at) : byteAt(text, at) & (0x3fu >> followers);
  for (int i = 1; i <= followers; ++i) {
    const std::uint32_t next = byteAt(text, at + static_cast<std::size_t>(i));
    if ((next & 0xc0u) != 0x80u) return 0;
    letter = (letter << 6) | (next & 0x3fu);
  }
  return mayStand(letter, followers) ? 1 + static_cast<std::size_t>(followers) : 0;
}

}  // namespace

std::string readableText(std::string_view text) {
  std::string readable;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t bytes = letterAt(text, at);
    readable += bytes == 0 ? kReplacement : text.substr(at, bytes);
    at += bytes == 0 ? 1 : bytes;
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
