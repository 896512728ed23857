// One pass, line by line: refuse control bytes, cut the comment, split at commas. Fields are views of the text in one
// list that all rows share, so rows allocate nothing once it has grown.
// Data flow: tables of trajectories, forces, profiles and maps -> here, at load time -> the room that reads them.
#include "palpate/base/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/base/text.h"

namespace palpate {

namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
/// Longer than any field of ours; keeps a message one readable line when a field is garbage.
constexpr std::size_t kMaxQuotedField = 40;

void refuseControlBytes(std::string_view row, std::string_view file, std::size_t line) {
  for (const char c : row) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 && c != '\t' && c != '\r') {
      throw Error::atLine(file, line, fmt::format("not a text table (byte 0x{:02x})", byte));
    }
  }
}

std::string_view withoutComment(std::string_view row) { return trimmed(row.substr(0, row.find('#'))); }

void splitInto(std::vector<std::string_view>& fields, std::string_view row) {
  fields.clear();
  for (std::size_t begin = 0; begin <= row.size();) {
    const std::size_t end = std::min(row.find(',', begin), row.size());
    fields.push_back(trimmed(row.substr(begin, end - begin)));
    begin = end + 1;
  }
}

}  // namespace

void forEachCsvRow(std::string_view text, std::string_view file, const std::function<void(const CsvRow&)>& visit) {
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  std::vector<std::string_view> fields;
  for (std::size_t begin = 0, line = 1; begin < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view row = text.substr(begin, end - begin);
    begin = end + 1;
    refuseControlBytes(row, file, line);
    const std::string_view content = withoutComment(row);
    if (content.empty()) continue;
    splitInto(fields, content);
    visit({file, line, fields});
  }
}

double csvNumber(const CsvRow& row, std::size_t column, std::string_view column_name) {
  const std::string_view field = row.fields[column];
  const auto value = parseNumber(field);
  if (!value) {
    throw Error::atLine(row.file, row.line,
                        fmt::format("{} is not a number: '{}'", column_name, field.substr(0, kMaxQuotedField)));
  }
  if (!std::isfinite(*value)) throw Error::atLine(row.file, row.line, fmt::format("{} is {}", column_name, field));
  return *value;
}

double csvNumber(const CsvRow& row, std::size_t column, std::string_view column_name, const NumberRange& range) {
  const double value = csvNumber(row, column, column_name);
  if (range.holds(value)) return value;
  throw Error::atLine(row.file, row.line,
                      fmt::format("{} = {}", column_name, outOfRange(fmt::format("{}", value), range)));
}

bool looksLikeCsvHeader(const CsvRow& row) { return !parseNumber(row.fields.front()).has_value(); }

// Based on: OWASP, "CSV Injection"; RFC 4180 for quotes.

namespace {

// The last four are = + - @ in full width (U+FF1D, U+FF0B, U+FF0D, U+FF20), which some spreadsheets read alike.
constexpr std::array<std::string_view, 11> kFormulaBegins = {
    "=", "+", "-", "@", "\t", "\r", "\n", "\xef\xbc\x9d", "\xef\xbc\x8b", "\xef\xbc\x8d", "\xef\xbc\xa0"};

bool isFormula(std::string_view text) {
  const auto begins = [text](std::string_view begin) { return text.starts_with(begin); };
  if (std::none_of(kFormulaBegins.begin(), kFormulaBegins.end(), begins)) return false;
  const auto number = parseNumber(text);
  return !number || !std::isfinite(*number) || text != trimmed(text);
}

}  // namespace

std::string csvTextCell(std::string_view text, CsvText kind) {
  std::string cell = kind == CsvText::safe && isFormula(text) ? "'" : "";
  cell += text;
  if (cell.find_first_of(",\"\r\n") == std::string::npos) return cell;
  std::string quoted = "\"";
  for (const char c : cell) {
    quoted += c;
    if (c == '"') quoted += c;
  }
  return quoted + '"';
}

}  // namespace palpate
