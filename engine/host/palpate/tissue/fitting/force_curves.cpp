// Columns are found by the header's words, rows sorted to their curves as they come.
#include "palpate/tissue/fitting/force_curves.h"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <utility>

#include "palpate/base/csv.h"
#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/text.h"
#include "palpate/tissue/fitting/table_columns.h"

namespace palpate::tissue {

namespace {

constexpr std::uint64_t kMaxCurveBytes = 64'000'000;
constexpr std::size_t kMaxCurves = 10'000;
constexpr std::size_t kLongestCurveName = 60;
constexpr NumberRange kCurveDepths{-1000.0, 1000.0};
constexpr NumberRange kCurveForces{-1e6, 1e6};

/// Where a row has what.
struct Columns {
  std::size_t depth = 0;
  std::size_t force = 1;
  std::optional<std::size_t> curve;
  std::size_t count = 2;
};

Columns findColumns(const CsvRow& header) {
  Columns columns{neededColumn(header, "depth_mm"), neededColumn(header, "force_n"), std::nullopt,
                  header.fields.size()};
  for (const std::string_view name : {"curve", "place", "id"}) {
    if (!columns.curve) columns.curve = columnOf(header, name);
  }
  return columns;
}

class CurveReader {
 public:
  void addRow(const CsvRow& row) {
    if (std::exchange(first_, false) && looksLikeCsvHeader(row)) {
      columns_ = findColumns(row);
      return;
    }
    checkFields(row, columns_.count);
    ForceCurve& curve = findOrAddCurve(row);
    curve.depth_mm.push_back(csvNumber(row, columns_.depth, "depth_mm", kCurveDepths));
    curve.force_n.push_back(csvNumber(row, columns_.force, "force_n", kCurveForces));
  }

  std::vector<ForceCurve> curves;

 private:
  ForceCurve& findOrAddCurve(const CsvRow& row) {
    const std::string name = columns_.curve ? oneLine(row.fields[*columns_.curve], kLongestCurveName) : std::string();
    const auto [place, fresh] = numbers_.try_emplace(name, curves.size());
    if (fresh) {
      if (curves.size() == kMaxCurves)
        throw Error::atLine(row.file, row.line, fmt::format("too many curves; expected at most {}", kMaxCurves));
      curves.emplace_back().name = name;
    }
    return curves[place->second];
  }

  bool first_ = true;
  Columns columns_;
  std::map<std::string, std::size_t> numbers_;
};

}  // namespace

std::vector<ForceCurve> parseForceCurves(std::string_view text, std::string_view name) {
  CurveReader reader;
  forEachCsvRow(text, name, [&](const CsvRow& row) { reader.addRow(row); });
  if (reader.curves.empty()) throw Error::inFile(name, "has no rows; expected depth_mm,force_n");
  return std::move(reader.curves);
}

std::vector<ForceCurve> readForceCurves(const std::filesystem::path& file) {
  return parseForceCurves(readFile(file, kMaxCurveBytes), file.string());
}

}  // namespace palpate::tissue
