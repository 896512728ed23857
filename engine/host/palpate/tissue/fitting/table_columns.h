// Where a stranger's table has what: columns by the words of its header.
#pragma once

#include <optional>
#include <string_view>

#include "palpate/base/csv.h"

namespace palpate::tissue {

std::optional<std::size_t> columnOf(const CsvRow& header, std::string_view name);

/// Throws Error naming the line if the column is missing.
std::size_t neededColumn(const CsvRow& header, std::string_view name);

/// Throws Error naming the line of a row with more or fewer fields than the header.
void checkFields(const CsvRow& row, std::size_t fields);

}  // namespace palpate::tissue
