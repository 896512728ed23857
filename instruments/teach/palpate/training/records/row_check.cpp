// Checks texts and numbers of a row. A row refused here would be refused by one of the two databases, or be misread by
// readers of an export.
#include "palpate/training/records/row_check.h"

#include <fmt/format.h>

#include <algorithm>

#include "palpate/base/error.h"
#include "palpate/base/text.h"

namespace palpate::training {

namespace {

bool isLowerHex(char letter) { return (letter >= '0' && letter <= '9') || (letter >= 'a' && letter <= 'f'); }

bool isWordLetter(char letter) {
  return (letter >= '0' && letter <= '9') || (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
         letter == '.' || letter == '_' || letter == '-';
}

/// PostgreSQL refuses bytes that are of no letter of UTF-8, with the whole batch.
bool isPlainText(std::string_view text) {
  while (!text.empty()) {
    const auto first = static_cast<unsigned char>(text.front());
    if ((first < 0x20 && first != '\n' && first != '\t' && first != '\r') || first == 0x7f) return false;
    const std::size_t length = letterBytes(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

/// "sessions/x.session": nothing absolute, no step up, no other drive.
bool isInnerFile(std::string_view text) {
  if (text.front() == '/' || text.find_first_of("\\:\n\r\t") != std::string_view::npos || !isPlainText(text)) {
    return false;
  }
  return fmt::format("/{}/", text).find("/../") == std::string::npos;
}

/// Empty: nothing is wrong.
std::string_view faultOfText(const std::string& value, FieldRule::Form form) {
  switch (form) {
    case FieldRule::Form::text:
      return isPlainText(value) ? "" : "has bytes that are not text";
    case FieldRule::Form::word:
      return std::ranges::all_of(value, isWordLetter) ? "" : "has other letters than a-z, A-Z, 0-9, '.', '_' and '-'";
    case FieldRule::Form::uuid:
      return isUuid(value) ? "" : "must be a UUID";
    case FieldRule::Form::hash:
      return isHash(value) ? "" : "must be a SHA-256 hash";
    case FieldRule::Form::file:
      return isInnerFile(value) ? "" : "leads out of the folder";
    case FieldRule::Form::number:
    case FieldRule::Form::seed:
      break;
  }
  return "";
}

}  // namespace

bool isUuid(std::string_view text) {
  if (text.size() != 36) return false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool dash = i == 8 || i == 13 || i == 18 || i == 23;
    if (dash ? text[i] != '-' : !isLowerHex(text[i])) return false;
  }
  return true;
}

bool isHash(std::string_view text) { return text.size() == 64 && std::ranges::all_of(text, isLowerHex); }

void checkField(std::string_view kind, std::string_view name, const std::string& value, const FieldRule& rule) {
  if (value.empty()) {
    if (!rule.may_be_empty) throw Error(fmt::format("{}: '{}' is empty", kind, name));
    return;
  }
  if (value.size() > rule.longest) {
    throw Error(fmt::format("{}: '{}' has {} bytes, more than {}", kind, name, value.size(), rule.longest));
  }
  const std::string_view fault = faultOfText(value, rule.form);
  if (!fault.empty()) throw Error(fmt::format("{}: '{}' {}", kind, name, fault));
}

void checkField(std::string_view kind, std::string_view name, double value, const FieldRule& rule) {
  // Also refuses NaN.
  if (!(value >= rule.low && value <= rule.high)) {
    throw Error(fmt::format("{}: '{}' is {}, not within {} to {}", kind, name, value, rule.low, rule.high));
  }
}

}  // namespace palpate::training
