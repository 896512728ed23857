// One position in the text and the number of its line; words are views into it, so that reading allocates nothing.
#include "palpate/mesh/files/detail/text_reader.h"

#include <fmt/format.h>

#include <charconv>

#include "palpate/base/error.h"
#include "palpate/base/text.h"

namespace palpate::mesh {

namespace {

/// Reports often enough for a smooth display and seldom enough to cost nothing.
constexpr std::size_t kBytesPerReport = std::size_t{1} << 22;

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
bool isLineEnd(char c) { return c == '\n' || c == '\r'; }

}  // namespace

TextReader::TextReader(std::string_view text, std::string_view name, const Progress& progress)
    : text_(text), name_(name), progress_(progress) {}

std::string_view TextReader::word() {
  while (position_ < text_.size() && isBlank(text_[position_])) ++position_;
  const std::size_t start = position_;
  while (position_ < text_.size() && !isBlank(text_[position_]) && !isLineEnd(text_[position_])) ++position_;
  return text_.substr(start, position_ - start);
}

std::string_view TextReader::wordAnywhere() {
  while (true) {
    if (const auto found = word(); !found.empty()) return found;
    if (!nextLine()) return {};
  }
}

std::string_view TextReader::restOfLine() const {
  std::size_t end = position_;
  while (end < text_.size() && !isLineEnd(text_[end])) ++end;
  return trimmed(text_.substr(position_, end - position_));
}

bool TextReader::nextLine() {
  while (position_ < text_.size() && !isLineEnd(text_[position_])) ++position_;
  if (position_ == text_.size()) return false;
  const bool two_bytes = text_[position_] == '\r' && position_ + 1 < text_.size() && text_[position_ + 1] == '\n';
  position_ += two_bytes ? 2 : 1;
  if (position_ == text_.size()) return false;
  ++line_;
  if (position_ >= next_report_) reportProgress();
  return true;
}

bool TextReader::nextFilledLine(char comment) {
  while (nextLine()) {
    const auto rest = restOfLine();
    if (!rest.empty() && rest.front() != comment) return true;
  }
  return false;
}

double TextReader::number(std::string_view word, std::string_view what) const {
  if (word.empty()) fail(fmt::format("{} is missing", what));
  const auto value = parseNumber(word);
  if (!value) fail(fmt::format("{} is not a number: '{}'", what, shown(word)));
  return *value;
}

long long TextReader::whole(std::string_view word, std::string_view what, long long low, long long high) const {
  if (word.empty()) fail(fmt::format("{} is missing", what));
  long long value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) {
    fail(fmt::format("{} is not a whole number: '{}'", what, shown(word)));
  }
  if (value < low || value > high) fail(fmt::format("{} is {}, outside {} to {}", what, value, low, high));
  return value;
}

void TextReader::fail(std::string_view cause) const { throw Error::atLine(name_, line_, cause); }

void TextReader::reportProgress() {
  report(progress_, "reading", static_cast<double>(position_) / static_cast<double>(text_.size()));
  next_report_ = position_ + kBytesPerReport;
}

std::string shown(std::string_view word) {
  constexpr std::size_t kLongest = 24;
  std::string result;
  for (char c : word.substr(0, kLongest)) result += c >= ' ' && c <= '~' ? c : '?';
  if (word.size() > kLongest) result += "...";
  return result;
}

}  // namespace palpate::mesh
