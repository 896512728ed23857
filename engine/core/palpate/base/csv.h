// Comma-separated tables written by users: rows with their line numbers, numbers with an error that names the line.
//
// A table is plain text: one row per line, fields between commas, `#` starts a comment, blank lines are skipped, a byte
// order mark and lines that end in LF, CR LF or CR are accepted, and so are additions of spreadsheets: quotes around a
// field and commas behind the last column. Other separators, quotes within quotes and UTF-16 are refused, each with its
// own reason.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "palpate/base/error.h"
#include "palpate/base/number_range.h"

namespace palpate {

struct CsvRow {
  std::string_view file;                     ///< name for messages
  std::size_t line = 0;                      ///< counted from 1
  std::span<const std::string_view> fields;  ///< trimmed; valid during the visit only
};

/// Calls `visit` for every row with content. Throws Error at the first control byte (a binary file), and where the
/// first row shows that fields are not separated by commas.
void forEachCsvRow(std::string_view text, std::string_view file, const std::function<void(const CsvRow&)>& visit);

/// The finite number in `column`. Throws Error naming the line and the column otherwise.
double csvNumber(const CsvRow& row, std::size_t column, std::string_view column_name);

/// The same for a number that must be in a range.
double csvNumber(const CsvRow& row, std::size_t column, std::string_view column_name, const NumberRange& range);

/// "expected the header a,b, found 'a;b'": the error for another header, with the line.
Error unexpectedHeader(const CsvRow& row, std::string_view expected);

/// True when the row names columns instead of holding values, that is when its first field is not a number.
bool looksLikeCsvHeader(const CsvRow& row);

// Text as a cell of a table that a spreadsheet may open.

/// Treatment of a text that a spreadsheet would read as a formula: one that begins with = + - @, their full-width
/// forms, a tab or a line end.
enum class CsvText {
  safe,  ///< an apostrophe precedes it; numbers are unchanged
  raw,   ///< unchanged: for programs, which run no formulas
};

/// Quoted where it holds a comma, a quote or a line end.
std::string csvTextCell(std::string_view text, CsvText kind = CsvText::safe);

}  // namespace palpate
