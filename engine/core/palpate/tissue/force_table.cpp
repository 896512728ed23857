// Rows are checked one by one as they are read, so that a mistake is told with its line; a force at stiffness 1 N/mm is
// the effective depth of the law (force_law.h).
#include "palpate/tissue/user_profile.h"

#include <fmt/format.h>

#include <utility>

#include "palpate/base/csv.h"
#include "palpate/base/error.h"
#include "palpate/base/text.h"

namespace palpate::tissue {

namespace {

/// 64 rows take 2 KiB; comments may take the rest.
constexpr std::size_t kMaxForceTableBytes = std::size_t{1} << 16;
/// Deeper than any body, stiffer than any tissue: a number beyond it is a slip of the pen.
constexpr NumberRange kDepthsAndForces{0.0, 1e6};

[[noreturn]] void fail(const CsvRow& row, std::string_view cause) { throw Error::atLine(row.file, row.line, cause); }

void append(ForceTable& table, const CsvRow& row) {
  if (row.fields.size() != 2) fail(row, fmt::format("expected depth_mm,force_n, found {} fields", row.fields.size()));
  const double depth = csvNumber(row, 0, "depth_mm", kDepthsAndForces);
  const double force = csvNumber(row, 1, "force_n", kDepthsAndForces);
  if (table.rows == 0 && depth == 0.0) {
    if (force != 0.0) fail(row, "force_n must be 0 at depth 0");
    return;
  }
  if (table.rows == ForceTable::kMaxRows) fail(row, fmt::format("more than {} rows", ForceTable::kMaxRows));
  const double last_depth = table.rows == 0 ? 0.0 : table.depth_mm[table.rows - 1];
  const double last_force = table.rows == 0 ? 0.0 : table.effective_mm[table.rows - 1];
  if (!(depth > last_depth)) fail(row, fmt::format("depth_mm must increase, but {} follows {}", depth, last_depth));
  if (force < last_force) fail(row, fmt::format("force_n must not decrease, but {} follows {}", force, last_force));
  table.depth_mm[table.rows] = depth;
  table.effective_mm[table.rows] = force;
  ++table.rows;
}

}  // namespace

ForceTable parseForceTable(std::string_view text, std::string_view name) {
  ForceTable table;
  bool first = true;
  forEachCsvRow(text, name, [&](const CsvRow& row) {
    if (std::exchange(first, false) && looksLikeCsvHeader(row)) return;
    append(table, row);
  });
  if (table.rows == 0) throw Error::inFile(name, "requires at least one row with a depth above 0");
  return table;
}

ForceTable readForceTable(const std::filesystem::path& file) {
  return parseForceTable(readFile(file, kMaxForceTableBytes), file.string());
}

}  // namespace palpate::tissue
