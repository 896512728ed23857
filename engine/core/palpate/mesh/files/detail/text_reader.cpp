// One position in the text and the number of its line; words are views into it, so that reading allocates nothing.
#include "palpate/mesh/files/detail/text_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>

#include "palpate/base/error.h"
#include "palpate/base/text.h"

namespace palpate::mesh {

namespace {

/// Reports often enough for a smooth display and seldom enough to cost nothing.
constexpr std::size_t kBytesPerReport = std::size_t{1} << 22;

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
bool isLineEnd(char c) { return c == '\n' || c == '\r'; }

}  // namespace

TextReader::TextReader(std::string_view text, std::string_view name, const Progress& progress, TextRules rules)
    : text_(text), name_(name), progress_(progress), rules_(rules) {
  if (isUtf16(text)) fail("the text is UTF-16; save it as UTF-8");
  position_ = text.size() - withoutByteOrderMark(text).size();
}

std::size_t TextReader::behindLineEnd(std::size_t at) const {
  const bool two_bytes = text_[at] == '\r' && at + 1 < text_.size() && text_[at + 1] == '\n';
  return at + (two_bytes ? 2 : 1);
}

std::size_t TextReader::behindContinuation(std::size_t at) const {
  if (!rules_.continues || text_[at] != '\\') return 0;
  do {
    ++at;
  } while (at < text_.size() && isBlank(text_[at]));
  if (at == text_.size()) return at;
  return isLineEnd(text_[at]) ? behindLineEnd(at) : 0;
}

std::string_view TextReader::wordUpTo(char comment) {
  while (position_ < text_.size()) {
    if (isBlank(text_[position_])) {
      ++position_;
    } else if (const std::size_t behind = behindContinuation(position_); behind != 0) {
      position_ = behind;
      ++line_;
    } else {
      break;
    }
  }
  const std::size_t start = position_;
  if (start == text_.size() || (comment != '\0' && text_[start] == comment)) return {};
  while (position_ < text_.size() && !isBlank(text_[position_]) && !isLineEnd(text_[position_]) &&
         behindContinuation(position_) == 0) {
    ++position_;
  }
  return text_.substr(start, position_ - start);
}

std::string_view TextReader::word() { return wordUpTo(rules_.comment); }

std::string_view TextReader::nameWord() { return wordUpTo('\0'); }

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
  // A comment ends with its line: "# C:\scans\" does not continue.
  bool in_comment = false;
  for (bool between_words = true; position_ < text_.size() && !isLineEnd(text_[position_]);) {
    const char c = text_[position_];
    in_comment |= between_words && rules_.comment != '\0' && c == rules_.comment;
    const std::size_t behind = in_comment ? 0 : behindContinuation(position_);
    between_words = behind != 0 || isBlank(c);
    position_ = behind != 0 ? behind : position_ + 1;
    line_ += behind != 0 ? 1 : 0;
  }
  if (position_ == text_.size()) return false;
  position_ = behindLineEnd(position_);
  if (position_ == text_.size()) return false;
  ++line_;
  if (position_ >= next_report_) reportProgress();
  return true;
}

bool TextReader::nextFilledLine() {
  while (nextLine()) {
    while (position_ < text_.size() && isBlank(text_[position_])) ++position_;
    if (position_ == text_.size() || isLineEnd(text_[position_])) continue;
    if (rules_.comment == '\0' || text_[position_] != rules_.comment) return true;
  }
  return false;
}

double TextReader::number(std::string_view word, std::string_view what) const {
  if (word.empty()) fail(fmt::format("{} is missing", what));
  const auto value = parseNumber(word);
  if (!value && word.find(".#") != std::string_view::npos) return std::numeric_limits<double>::quiet_NaN();
  if (!value) fail(fmt::format("{} is not a number: '{}'", what, shown(word)));
  return *value;
}

long long TextReader::whole(std::string_view word, std::string_view what, long long low, long long high) const {
  if (word.empty()) fail(fmt::format("{} is missing", what));
  long long value = 0;
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
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

double numberOrNone(std::string_view word) {
  return parseNumber(word).value_or(std::numeric_limits<double>::quiet_NaN());
}

bool isWord(std::string_view word, std::string_view keyword) {
  return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(),
                    [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b; });
}

std::string shown(std::string_view word) {
  constexpr std::size_t kLongest = 24;
  std::string result;
  for (char c : word.substr(0, kLongest)) result += c >= ' ' && c <= '~' ? c : '?';
  if (word.size() > kLongest) result += "...";
  return result;
}

}  // namespace palpate::mesh
