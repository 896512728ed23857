// One pass, line by line: refuse control bytes, cut the comment, split at commas outside quotes. Fields are views of
// the text in one list that all rows share, so rows allocate nothing once it has grown. Data flow: tables of
// trajectories, forces, profiles and maps -> here, at load time -> their readers.
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

/// Longer than any field of ours; keeps a message one readable line when a field is garbage.
constexpr std::size_t kMaxQuotedField = 40;

void refuseControlBytes(std::string_view row, std::string_view file, std::size_t line) {
  for (const char c : row) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 && c != '\t') {
      throw Error::atLine(file, line,
                          fmt::format("not a text table (byte 0x{:02x}); expected comma-separated text", byte));
    }
  }
}

/// A comment sign within quotes is a letter.
std::string_view withoutComment(std::string_view row) {
  std::size_t sign = row.find('#');
  if (sign != std::string_view::npos && row.find('"') < sign) {
    bool quoted = false;
    for (sign = 0; sign < row.size() && (quoted || row[sign] != '#'); ++sign) quoted ^= row[sign] == '"';
  }
  return trimmed(row.substr(0, sign));
}

/// Cuts the field at the front of `rest` off, with its comma. `is_last`: there was none.
std::string_view popField(std::string_view& rest, bool& is_last, std::string_view file, std::size_t line) {
  const std::size_t first = rest.find_first_not_of(" \t");
  const bool quoted = first != std::string_view::npos && rest[first] == '"';
  std::size_t begin = 0;
  std::size_t end = 0;
  std::size_t comma = 0;
  if (quoted) {
    begin = first + 1;
    end = rest.find('"', begin);
    if (end == std::string_view::npos)
      throw Error::atLine(file, line, "a quoted field is not closed on its line; add the closing quote");
    comma = std::min(rest.find(',', end), rest.size());
    if (!trimmed(rest.substr(end + 1, comma - end - 1)).empty()) {
      throw Error::atLine(file, line, "unexpected text after a quoted field; quotes inside a field are not supported");
    }
  } else {
    end = comma = std::min(rest.find(','), rest.size());
  }
  const std::string_view field = trimmed(rest.substr(begin, end - begin));
  is_last = comma == rest.size();
  rest.remove_prefix(is_last ? comma : comma + 1);
  return field;
}

void splitInto(std::vector<std::string_view>& fields, std::string_view row, std::string_view file, std::size_t line) {
  fields.clear();
  for (bool is_last = false; !is_last;) fields.push_back(popField(row, is_last, file, line));
}

bool isNumberWithComma(std::string_view field) {
  std::string with_point(field);
  std::replace(with_point.begin(), with_point.end(), ',', '.');
  return parseNumber(with_point).has_value();
}

/// Judges the first row alone. Spreadsheets write semicolons where a comma is the decimal sign.
void refuseOtherSeparators(std::string_view row, std::string_view file, std::size_t line) {
  const bool has_comma = row.find(',') != std::string_view::npos;
  const std::vector<std::string_view> by_semicolon = split(row, ';');
  const bool all_numbers = std::all_of(by_semicolon.begin(), by_semicolon.end(), isNumberWithComma);
  if (by_semicolon.size() > 1 && (!has_comma || all_numbers)) {
    throw Error::atLine(
        file, line, "fields are separated by semicolons; save the table with commas between fields and decimal points");
  }
  const std::size_t blank = row.find_first_of(" \t");
  if (has_comma || blank == std::string_view::npos) return;
  const bool by_tabs = row.find('\t') != std::string_view::npos;
  if (!by_tabs && !isNumberWithComma(row.substr(0, blank))) return;  // a name of several words
  throw Error::atLine(
      file, line,
      fmt::format("fields are separated by {}; save the table with commas between them", by_tabs ? "tabs" : "spaces"));
}

/// Finds the ends of lines: LF, CR LF or CR. A text without one kind is searched for it once.
class LineEnds {
 public:
  explicit LineEnds(std::string_view text) : text_(text) {}
  /// The next row's text; `begin` moves behind its end.
  std::string_view rowFrom(std::size_t& begin) {
    if (lf_ < begin || begin == 0) lf_ = std::min(text_.find('\n', begin), text_.size());
    if (cr_ < begin || begin == 0) cr_ = std::min(text_.find('\r', begin), text_.size());
    const std::size_t end = std::min(lf_, cr_);
    const std::string_view row = text_.substr(begin, end - begin);
    begin = end + (cr_ + 1 == lf_ && lf_ < text_.size() ? 2 : 1);
    return row;
  }

 private:
  std::string_view text_;
  std::size_t lf_ = 0;
  std::size_t cr_ = 0;
};

}  // namespace

void forEachCsvRow(std::string_view text, std::string_view file, const std::function<void(const CsvRow&)>& visit) {
  if (isUtf16(text)) throw Error::atLine(file, 1, "the text is UTF-16; save it as UTF-8");
  text = withoutByteOrderMark(text);
  LineEnds lines(text);
  std::vector<std::string_view> fields;
  std::size_t named = 0;  // columns of the first row up to its last that is not empty
  bool has_more = false;  // the first row ends in commas
  for (std::size_t begin = 0, line = 1; begin < text.size(); ++line) {
    const std::string_view row = lines.rowFrom(begin);
    refuseControlBytes(row, file, line);
    const std::string_view content = withoutComment(row);
    if (content.empty()) continue;
    if (named == 0) refuseOtherSeparators(content, file, line);
    splitInto(fields, content, file, line);
    const bool is_first = named == 0;
    if (is_first || has_more) {
      const std::size_t least = is_first ? 1 : named;
      while (fields.size() > least && fields.back().empty()) {
        fields.pop_back();
        has_more = true;
      }
    }
    if (is_first) named = fields.size();
    visit({file, line, fields});
  }
}

Error unexpectedHeader(const CsvRow& row, std::string_view expected) {
  constexpr std::size_t kMaxShown = 80;
  std::string found;
  for (const std::string_view field : row.fields) found += fmt::format("{}{}", found.empty() ? "" : ",", field);
  return Error::atLine(row.file, row.line,
                       fmt::format("expected the header {}, found '{}'", expected,
                                   wellFormed(found.substr(0, kMaxShown)) + (found.size() > kMaxShown ? "..." : "")));
}

double csvNumber(const CsvRow& row, std::size_t column, std::string_view column_name) {
  const std::string_view field = row.fields[column];
  const auto value = parseNumber(field);
  if (!value) {
    throw Error::atLine(row.file, row.line,
                        fmt::format("{} is not a number: '{}'", column_name, field.substr(0, kMaxQuotedField)));
  }
  if (!std::isfinite(*value))
    throw Error::atLine(row.file, row.line, fmt::format("{} must be finite, got {}", column_name, field));
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
