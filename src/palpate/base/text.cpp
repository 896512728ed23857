// Numbers by std::from_chars, which knows no locale but takes no leading plus either: that is cut off first. A file's
// size is asked before memory is taken for it; one that shrinks meanwhile is read as far as it goes. Cold path. Own.
#include "palpate/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>

#include "palpate/base/error.h"
#include "palpate/base/output_file.h"

namespace palpate {

namespace {

constexpr std::string_view kBlanks = " \t\r\n\v\f";

std::size_t sizeOfReadableFile(const std::filesystem::path& file, std::uint64_t max_bytes) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) throw Error::inFile(file.string(), "no such file");
  if (!std::filesystem::is_regular_file(status)) throw Error::inFile(file.string(), "not a file");
  const std::uint64_t size = std::filesystem::file_size(file, error);
  if (error) throw Error::inFile(file.string(), error.message());
  const std::uint64_t limit = std::min<std::uint64_t>(max_bytes, std::numeric_limits<std::size_t>::max());
  if (size > limit) {
    throw Error::inFile(file.string(), fmt::format("{} bytes is more than the limit of {}", size, limit));
  }
  return static_cast<std::size_t>(size);
}

}  // namespace

std::string readFile(const std::filesystem::path& file, std::uint64_t max_bytes) {
  std::string content(sizeOfReadableFile(file, max_bytes), '\0');
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw Error::inFile(file.string(), "cannot be opened for reading");
  stream.read(content.data(), static_cast<std::streamsize>(content.size()));
  content.resize(static_cast<std::size_t>(stream.gcount()));
  return content;
}

void writeFile(const std::filesystem::path& file, std::string_view content) {
  OutputFile output(file);
  output.write(content);
  output.commit();
}

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
