#include "palpate/tissue/fitting/table_columns.h"

#include <fmt/format.h>

#include <algorithm>

#include "palpate/base/error.h"

namespace palpate::tissue {

std::optional<std::size_t> columnOf(const CsvRow& header, std::string_view name) {
  const auto found = std::ranges::find(header.fields, name);
  if (found == header.fields.end()) return std::nullopt;
  return static_cast<std::size_t>(found - header.fields.begin());
}

std::size_t neededColumn(const CsvRow& header, std::string_view name) {
  const auto column = columnOf(header, name);
  if (!column) throw Error::atLine(header.file, header.line, fmt::format("the header has no column {}", name));
  return *column;
}

void checkFields(const CsvRow& row, std::size_t fields) {
  if (row.fields.size() == fields) return;
  throw Error::atLine(row.file, row.line, fmt::format("found {} fields; expected {}", row.fields.size(), fields));
}

}  // namespace palpate::tissue
