// Text as a cell of a table that a spreadsheet may open.
#pragma once

#include <string>
#include <string_view>

namespace palpate {

/// What becomes of a text that a spreadsheet would take for a formula: one that begins with = + - @, their full-width
/// forms, a tab or a line end.
enum class CsvText {
  safe,  ///< an apostrophe stands before it; a number stays what it is
  raw,   ///< nothing: for programs, which take no formulas
};

/// Quoted where it holds a comma, a quote or a line end.
std::string csvTextCell(std::string_view text, CsvText kind = CsvText::safe);

}  // namespace palpate
