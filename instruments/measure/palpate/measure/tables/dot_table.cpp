#include "palpate/measure/tables/dot_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "palpate/base/csv.h"
#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/text.h"

namespace palpate::measure {

namespace {

constexpr std::string_view kHeader = "picture,x_px,y_px";
constexpr std::string_view kArea = "area_px";
constexpr std::size_t kFields = 3;
constexpr std::uint64_t kMaxTableBytes = 16'000'000;
// No camera has more pixels in a row.
constexpr NumberRange kPlacesPx{-1e5, 1e5};
constexpr NumberRange kAreasPx{0.0, 1e9};

/// Whether there is a fourth column.
bool readHeader(const CsvRow& row) {
  const auto expected = split(kHeader, ',');
  const bool has_area = row.fields.size() == kFields + 1 && row.fields[kFields] == kArea;
  const bool has_length = row.fields.size() == kFields || has_area;
  if (!has_length || !std::equal(expected.begin(), expected.end(), row.fields.begin())) {
    throw unexpectedHeader(row, fmt::format("{}[,{}]", kHeader, kArea));
  }
  return has_area;
}

Dot parseDot(const CsvRow& row, bool has_area) {
  const std::size_t wanted = has_area ? kFields + 1 : kFields;
  if (row.fields.size() != wanted) {
    throw Error::atLine(row.file, row.line,
                        fmt::format("expected the {} fields of the header, found {}", wanted, row.fields.size()));
  }
  Dot dot{.place_px = {csvNumber(row, 1, "x_px", kPlacesPx), csvNumber(row, 2, "y_px", kPlacesPx)}};
  if (has_area && !row.fields[kFields].empty()) dot.area_px = csvNumber(row, kFields, kArea, kAreasPx);
  return dot;
}

void addRow(const CsvRow& row, bool has_area, DotPair& pair) {
  const std::string_view picture = row.fields.front();
  if (picture != "before" && picture != "after") {
    throw Error::atLine(row.file, row.line, fmt::format("picture '{}' must be before or after", oneLine(picture)));
  }
  std::vector<Dot>& dots = picture == "before" ? pair.before : pair.after;
  dots.push_back(parseDot(row, has_area));
  if (dots.size() > kMaxTableMarks) {
    throw Error::atLine(row.file, row.line, fmt::format("too many dots for one picture; at most {}", kMaxTableMarks));
  }
}

}  // namespace

DotPair readDotTable(const std::filesystem::path& file) {
  return parseDotTable(readFile(file, kMaxTableBytes), file.string());
}

DotPair parseDotTable(std::string_view text, std::string_view file) {
  DotPair pair;
  bool first = true;
  bool has_area = false;
  forEachCsvRow(text, file, [&](const CsvRow& row) {
    if (first) {
      has_area = readHeader(row);
      first = false;
    } else {
      addRow(row, has_area, pair);
    }
  });
  if (pair.before.empty()) throw Error::inFile(file, "has no dots of the picture before");
  if (pair.after.empty()) throw Error::inFile(file, "has no dots of the picture after");
  return pair;
}

std::string formatDotTable(const Measurement& measurement) {
  std::string table = fmt::format("{},{}\n", kHeader, kArea);
  const auto add = [&](const char* picture, const Dot& dot) {
    table += fmt::format("{},{:.3f},{:.3f},{:.1f}\n", picture, dot.place_px.x(), dot.place_px.y(), dot.area_px);
  };
  for (const GridDot& dot : measurement.grid.dots) add("before", dot.dot);
  for (const Dot& dot : measurement.grid.strays) add("before", dot);
  for (const Dot& dot : measurement.after_dots) add("after", dot);
  return table;
}

}  // namespace palpate::measure
