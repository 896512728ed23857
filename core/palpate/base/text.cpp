// Numbers by std::from_chars, which knows no locale but takes no leading plus either: that is cut off first.
#include "palpate/base/text.h"

#include <algorithm>
#include <charconv>

#include "palpate/base/environment.h"

namespace palpate {

namespace {

constexpr std::string_view kBlanks = " \t\r\n\v\f";

}  // namespace

std::string readFile(const std::filesystem::path& file, std::uint64_t max_bytes) {
  return environment().read_file(file, max_bytes);
}

void writeFile(const std::filesystem::path& file, std::string_view content) { environment().write_file(file, content); }

std::optional<double> parseNumber(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
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

}  // namespace palpate
