// Columns are taken by their number, so the header must be the writer's word for word: a table of another version is
// refused, not misread.
// Data flow: forces.csv -> here, at load time -> a replay in the window. Own.
#include "palpate/trace/forces_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "palpate/base/csv.h"
#include "palpate/base/error.h"
#include "palpate/base/output_file.h"
#include "palpate/base/text.h"
#include "palpate/trace/forces_csv.h"

namespace palpate::trace {

namespace {

/// An hour of two fingers takes about that much.
constexpr std::size_t kMostBytes = std::size_t{2} << 30;
// Columns of forcesCsvHeader().
constexpr std::size_t kTime = 0;
constexpr std::size_t kFinger = 1;
constexpr std::size_t kTip = 2;
constexpr std::size_t kForce = 11;

Vec3 vectorFrom(const CsvRow& row, std::size_t column, std::string_view name) {
  // What writes these tables writes places and forces of a body's size; larger ones are no record of a touch.
  constexpr NumberRange kRecorded{-1e9, 1e9};
  return {csvNumber(row, column, name, kRecorded), csvNumber(row, column + 1, name, kRecorded),
          csvNumber(row, column + 2, name, kRecorded)};
}

RecordedFinger& fingerNamed(std::vector<RecordedFinger>& fingers, std::string_view name) {
  const auto found = std::find_if(fingers.begin(), fingers.end(), [&](const auto& f) { return f.name == name; });
  if (found != fingers.end()) return *found;
  fingers.push_back({std::string(name), {}, {}, {}});
  return fingers.back();
}

void addRow(const CsvRow& row, std::vector<RecordedFinger>& fingers) {
  RecordedFinger& finger = fingerNamed(fingers, row.fields[kFinger]);
  const double time_s = csvNumber(row, kTime, "t_s", {-1e9, 1e9});
  if (!finger.time_s.empty() && time_s <= finger.time_s.back()) {
    throw Error::atLine(row.file, row.line,
                        fmt::format("time does not increase: {} s after {} s", time_s, finger.time_s.back()));
  }
  finger.time_s.push_back(time_s);
  finger.tip.push_back(vectorFrom(row, kTip, "tip"));
  finger.force.push_back(vectorFrom(row, kForce, "force"));
}

}  // namespace

std::vector<RecordedFinger> parseForcesTable(std::string_view text, std::string_view name) {
  const std::vector<std::string_view> header = split(forcesCsvHeader(), ',');
  std::vector<RecordedFinger> fingers;
  bool first = true;
  forEachCsvRow(text, name, [&](const CsvRow& row) {
    if (std::exchange(first, false)) {
      if (std::ranges::equal(row.fields, header)) return;
      throw Error::atLine(row.file, row.line, "is no table of forces: it begins with other columns");
    }
    if (row.fields.size() != header.size()) {
      throw Error::atLine(row.file, row.line,
                          fmt::format("expected {} fields, found {}", header.size(), row.fields.size()));
    }
    addRow(row, fingers);
  });
  if (fingers.empty()) throw Error::inFile(name, "holds no forces");
  return fingers;
}

std::vector<RecordedFinger> readForcesTable(const std::filesystem::path& file) {
  std::string text = readFile(file, kMostBytes);
  // Of a table that was not finished the last row may be torn.
  if (isUnfinished(file)) text.resize(text.rfind('\n') + 1);
  return parseForcesTable(text, file.string());
}

bool isUnfinished(const std::filesystem::path& file) { return file.extension() == kPartialExtension; }

bool isForcesTable(const std::filesystem::path& file) {
  return file.extension() == ".csv" || (isUnfinished(file) && file.string().find(".csv.") != std::string::npos);
}

}  // namespace palpate::trace
