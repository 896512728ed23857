// The table read and written, and the built-in key points: means of what was measured at P1 to P5, put on the built-in
// body, P6 and P7 their mirror images.
//
// Based on: Ji, dissertation 2008, section 5.1 and Appendix C (measured_data.h).
#include "palpate/maps/key_points.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <numbers>

#include "palpate/base/csv.h"
#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/text.h"

namespace palpate::maps {

namespace {

constexpr std::string_view kHeader = "name,x_mm,y_mm,half_major_mm,major_over_minor,direction_deg";
constexpr std::string_view kStiffnessColumn = "stiffness_n_per_mm";
constexpr std::size_t kFields = 6;
/// 64 MiB: more than a million rows; anything longer is not a table of measurements.
constexpr std::size_t kMaxKeyFileBytes = std::size_t{64} << 20;
// Sizes and ratios have logarithms and inverses that are ordinary numbers; what is beyond them is a wrong unit.
constexpr NumberRange kPlacesMm{-1e5, 1e5};
constexpr NumberRange kHalfMajorsMm{1e-3, 1e4};  // a micrometre to ten metres
constexpr NumberRange kRatios{1e-3, 1e3};
constexpr NumberRange kDirectionsDeg{-360.0, 360.0};
constexpr NumberRange kStiffnesses{0.0, 1000.0};

constexpr NumberRange kAnyNumber{-1e12, 1e12};
constexpr std::array<std::string_view, 11> kMeasuredColumns = {
    "half_major_4_mm",  "peak_mm",  "tail_p",           "drift_mm",           "rim_mm",    "drag_deg",
    "sd_half_major_mm", "sd_ratio", "sd_direction_deg", "sd_half_major_4_mm", "sd_peak_mm"};

bool isFurtherColumn(std::string_view name) {
  return name == kStiffnessColumn || std::ranges::find(kMeasuredColumns, name) != kMeasuredColumns.end();
}

/// The columns behind the first six. A table without a header, or with the plain one, may have a stiffness or not, row
/// by row; a longer header lists the fields of each row.
struct FurtherColumns {
  std::vector<std::string> names = {std::string(kStiffnessColumn)};
  bool is_fixed = false;
};

void requireFields(const CsvRow& row, const FurtherColumns& further) {
  const std::size_t most = kFields + further.names.size();
  if (row.fields.size() == most || (row.fields.size() == kFields && !further.is_fixed)) return;
  if (further.is_fixed) {
    throw Error::atLine(row.file, row.line,
                        fmt::format("expected the {} fields of the header, found {}", most, row.fields.size()));
  }
  throw Error::atLine(row.file, row.line,
                      fmt::format("expected {} or {} fields ({}[,{}]), found {}", kFields, kFields + 1, kHeader,
                                  kStiffnessColumn, row.fields.size()));
}

/// The columns carry the units in their names, so a header that differs is not ours.
FurtherColumns readHeader(const CsvRow& row) {
  const auto expected = split(kHeader, ',');
  const bool starts_well = row.fields.size() >= kFields && std::ranges::equal(row.fields.subspan(0, kFields), expected);
  const bool has_stranger = starts_well && !std::ranges::all_of(row.fields.subspan(kFields), isFurtherColumn);
  if (!starts_well || (has_stranger && row.fields.size() == kFields + 1)) {
    throw unexpectedHeader(row, fmt::format("{}[,{}]", kHeader, kStiffnessColumn));
  }
  FurtherColumns further;
  const bool is_plain =
      row.fields.size() == kFields || (row.fields.size() == kFields + 1 && row.fields[kFields] == kStiffnessColumn);
  if (is_plain) return further;
  further = {.names = {}, .is_fixed = true};
  for (const std::string_view name : row.fields.subspan(kFields)) {
    if (!isFurtherColumn(name)) {
      throw Error::atLine(row.file, row.line,
                          fmt::format("'{}' is not a column of key points; expected {}, then any of {}, {}",
                                      oneLine(name), kHeader, kStiffnessColumn, fmt::join(kMeasuredColumns, ", ")));
    }
    if (std::ranges::find(further.names, name) != further.names.end()) {
      throw Error::atLine(row.file, row.line, fmt::format("column {} appears twice", name));
    }
    further.names.emplace_back(name);
  }
  return further;
}

Ellipse ellipseOf(const CsvRow& row) {
  const double half_major_mm = csvNumber(row, 3, "half_major_mm", kHalfMajorsMm);
  const double ratio = csvNumber(row, 4, "major_over_minor", kRatios);
  const double direction_deg = csvNumber(row, 5, "direction_deg", kDirectionsDeg);
  return canonicalEllipse(half_major_mm, half_major_mm / ratio, direction_deg * kRadPerDeg);
}

KeyPoint parseKeyPoint(const CsvRow& row, const FurtherColumns& further) {
  requireFields(row, further);
  KeyPoint key;
  key.name = row.fields[0];
  key.position_mm = {csvNumber(row, 1, "x_mm", kPlacesMm), csvNumber(row, 2, "y_mm", kPlacesMm)};
  if (!std::ranges::all_of(row.fields.subspan(3, 3), &std::string_view::empty)) key.ellipse = ellipseOf(row);
  for (std::size_t i = kFields; i < row.fields.size(); ++i) {
    if (row.fields[i].empty()) continue;
    const std::string& name = further.names[i - kFields];
    const bool is_stiffness = name == kStiffnessColumn;
    const double number = csvNumber(row, i, name, is_stiffness ? kStiffnesses : kAnyNumber);
    if (is_stiffness) key.stiffness_n_per_mm = number;
  }
  return key;
}

/// Mirrors it to the other side of the spine.
Ellipse mirrored(const Ellipse& e) {
  return canonicalEllipse(e.half_major_mm, e.half_major_mm * e.aspect, std::numbers::pi - e.direction_rad);
}

}  // namespace

std::span<const std::string_view> measuredColumns() { return kMeasuredColumns; }

std::vector<KeyPoint> readKeyPoints(const std::filesystem::path& file) {
  return parseKeyPoints(readFile(file, kMaxKeyFileBytes), file.string());
}

std::vector<KeyPoint> parseKeyPoints(std::string_view text, std::string_view file) {
  std::vector<KeyPoint> keys;
  FurtherColumns further;
  bool first = true;
  forEachCsvRow(text, file, [&](const CsvRow& row) {
    const bool is_header = first && row.fields.front() == "name";
    first = false;
    if (is_header) {
      further = readHeader(row);
    } else {
      keys.push_back(parseKeyPoint(row, further));
    }
  });
  return keys;
}

std::vector<KeyPoint> dissertationKeyPoints(const MeasuredDataChoice& choice) {
  // Tips of the spinous processes T5, T10 and L2 on the built-in body (published vertebral heights,
  // docs/explanation/maps.md).
  constexpr double kT5 = 73.0;
  constexpr double kT10 = -62.0;
  constexpr double kL2 = -173.0;
  constexpr double kUpper = 0.5 * (kT5 + kT10);
  constexpr double kLower = 0.5 * (kT10 + kL2);
  constexpr double kAside = 100.0;  // section 5.1: 10 cm from the midline
  const auto measured = [&](int point) { return meanEllipse(measuredAt(choice.force, point), choice.averaging); };
  return {{"P1", {0.0, kT5}, measured(1), {}},
          {"P2", {0.0, kT10}, measured(2), {}},
          {"P3", {0.0, kL2}, measured(3), {}},
          {"P4", {-kAside, kUpper}, measured(4), {}},
          {"P5", {-kAside, kLower}, measured(5), {}},
          {"P6", {kAside, kUpper}, mirrored(measured(4)), {}},
          {"P7", {kAside, kLower}, mirrored(measured(5)), {}}};
}

}  // namespace palpate::maps
