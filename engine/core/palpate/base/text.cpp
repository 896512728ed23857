// Numbers by std::from_chars, which ignores the locale but accepts no leading plus: that is cut off first.
#include "palpate/base/text.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdlib>

#include "palpate/base/environment.h"

namespace palpate {

namespace {

constexpr std::string_view kBlanks = " \t\r\n\v\f";
constexpr std::string_view kReplacement = "\xef\xbf\xbd";  // U+FFFD

}  // namespace

std::string readFile(const std::filesystem::path& file, std::uint64_t max_bytes) {
  return environment().read_file(file, max_bytes);
}

void writeFile(const std::filesystem::path& file, std::string_view content) { environment().write_file(file, content); }

std::optional<double> parseNumber(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0.0;
  if (!readNumber(text, value)) return std::nullopt;
  return value;
}

#if defined(__cpp_lib_to_chars) || defined(__GLIBCXX__)

bool readNumber(std::string_view text, double& value) noexcept {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

#else

// LLVM's library has it for whole numbers only before its version 20. strtod accepts more than from_chars: blanks, a
// plus, hexadecimal; and the decimal point of the locale, which no program of ours changes.
bool readNumber(std::string_view text, double& value) noexcept {
  constexpr std::size_t kLongest = 400;  // digits beyond it would not change the number of any real file
  char copy[kLongest + 1];
  const std::string_view digits = text.starts_with('-') ? text.substr(1) : text;
  const bool plain = !digits.empty() && digits.find_first_of("xX+- \t\r\n\v\f") != 0 &&
                     digits.find_first_of("xX") == std::string_view::npos;
  if (!plain || text.size() > kLongest) return false;
  text.copy(copy, text.size());
  copy[text.size()] = '\0';
  char* end = nullptr;
  errno = 0;
  value = std::strtod(copy, &end);
  return end == copy + text.size() && (errno != ERANGE || (value != 0.0 && std::isfinite(value)));
}

#endif

std::string inSmallLetters(std::string_view text) {
  std::string small(text);
  for (char& c : small) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return small;
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> fields;
  while (true) {
    const auto end = text.find(separator);
    fields.push_back(trimmed(text.substr(0, end)));
    if (end == std::string_view::npos) return fields;
    text.remove_prefix(end + 1);
  }
}

std::size_t letterBytes(std::string_view text) noexcept {
  const auto byte = [text](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const auto follows = [&byte](std::size_t i, unsigned low = 0x80, unsigned high = 0xbf) {
    return byte(i) >= low && byte(i) <= high;
  };
  const unsigned first = byte(0);
  if (first < 0x80) return text.empty() ? 0 : 1;
  if (first >= 0xc2 && first <= 0xdf) return follows(1) ? 2 : 0;
  if (first >= 0xe0 && first <= 0xef) {
    const bool second = follows(1, first == 0xe0 ? 0xa0 : 0x80, first == 0xed ? 0x9f : 0xbf);
    return second && follows(2) ? 3 : 0;
  }
  if (first >= 0xf0 && first <= 0xf4) {
    const bool second = follows(1, first == 0xf0 ? 0x90 : 0x80, first == 0xf4 ? 0x8f : 0xbf);
    return second && follows(2) && follows(3) ? 4 : 0;
  }
  return 0;
}

std::string_view withoutByteOrderMark(std::string_view text) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  return text.starts_with(kMark) ? text.substr(kMark.size()) : text;
}

bool isUtf16(std::string_view text) noexcept { return text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"); }

void appendLetter(std::string& text, char32_t letter) {
  const auto more = [&](unsigned shift) { text += static_cast<char>(0x80 | ((letter >> shift) & 0x3f)); };
  if (letter < 0x80) {
    text += static_cast<char>(letter);
  } else if (letter < 0x800) {
    text += static_cast<char>(0xc0 | letter >> 6);
    more(0);
  } else if (letter < 0x10000) {
    text += static_cast<char>(0xe0 | letter >> 12);
    more(6), more(0);
  } else {
    text += static_cast<char>(0xf0 | letter >> 18);
    more(12), more(6), more(0);
  }
}

std::string wellFormed(std::string_view text) {
  std::string good;
  while (!text.empty()) {
    const std::size_t bytes = letterBytes(text);
    good += bytes == 0 ? kReplacement : text.substr(0, bytes);
    text.remove_prefix(bytes == 0 ? 1 : bytes);
  }
  return good;
}

}  // namespace palpate
