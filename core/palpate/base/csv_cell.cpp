// Based on: OWASP, "CSV Injection"; RFC 4180 for quotes.
#include "palpate/base/csv_cell.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "palpate/base/text.h"

namespace palpate {

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
