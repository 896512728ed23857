// The table read and written, and the built-in key points: means of what was measured at P1 to P5, put on the built-in
// body, P6 and P7 their mirror images.
//
// Based on: Ji, dissertation 2008, section 5.1 and Appendix C (measured_data.h).
#include "palpate/maps/key_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "palpate/base/csv.h"
#include "palpate/base/error.h"
#include "palpate/base/text.h"

namespace palpate::maps {

namespace {

constexpr std::string_view kHeader = "name,x_mm,y_mm,half_major_mm,major_over_minor,direction_deg";
constexpr std::string_view kStiffnessColumn = "stiffness_n_per_mm";
constexpr std::size_t kFields = 6;
/// 64 MiB: more than a million rows; anything longer is not a table of measurements.
constexpr std::size_t kMaxKeyFileBytes = std::size_t{64} << 20;
constexpr double kMinHalfMajorMm = 1e-3;  // a micrometre: smaller is a wrong unit
constexpr double kMaxHalfMajorMm = 1e4;   // ten metres: no body is larger
constexpr double kMaxRatio = 1e3;         // longer ellipses are a wrong unit

/// A size or ratio whose logarithm and inverse stay ordinary numbers.
double within(const CsvRow& row, std::size_t column, std::string_view name, double low, double high) {
  const double value = csvNumber(row, column, name);
  if (value >= low && value <= high) return value;
  throw Error::atLine(row.file, row.line, fmt::format("{} = {} is not between {} and {}", name, value, low, high));
}

double stiffnessOf(const CsvRow& row) {
  const double value = csvNumber(row, kFields, kStiffnessColumn);
  if (value >= 0.0) return value;
  throw Error::atLine(row.file, row.line, fmt::format("{} = {} is negative", kStiffnessColumn, value));
}

void requireFields(const CsvRow& row) {
  if (row.fields.size() == kFields || row.fields.size() == kFields + 1) return;
  throw Error::atLine(row.file, row.line,
                      fmt::format("expected {} or {} fields ({}[,{}]), found {}", kFields, kFields + 1, kHeader,
                                  kStiffnessColumn, row.fields.size()));
}

/// The columns carry the units in their names, so a header that differs is not ours.
void requireHeader(const CsvRow& row) {
  auto expected = split(kHeader, ',');
  if (row.fields.size() > kFields) expected.push_back(kStiffnessColumn);
  if (std::ranges::equal(row.fields, expected)) return;
  throw Error::atLine(row.file, row.line, fmt::format("expected the header {}[,{}]", kHeader, kStiffnessColumn));
}

KeyPoint keyPointOf(const CsvRow& row) {
  requireFields(row);
  KeyPoint key;
  key.name = row.fields[0];
  key.position_mm = {csvNumber(row, 1, "x_mm"), csvNumber(row, 2, "y_mm")};
  const double half_major_mm = within(row, 3, "half_major_mm", kMinHalfMajorMm, kMaxHalfMajorMm);
  const double ratio = within(row, 4, "major_over_minor", 1.0 / kMaxRatio, kMaxRatio);
  key.ellipse = canonicalEllipse(half_major_mm, half_major_mm / ratio, csvNumber(row, 5, "direction_deg") * kRadPerDeg);
  const bool has_stiffness = row.fields.size() > kFields && !row.fields[kFields].empty();
  if (has_stiffness) key.stiffness_n_per_mm = stiffnessOf(row);
  return key;
}

/// On the other side of the spine.
Ellipse mirrored(const Ellipse& e) {
  return canonicalEllipse(e.half_major_mm, e.half_major_mm * e.aspect, std::numbers::pi - e.direction_rad);
}

}  // namespace

std::vector<KeyPoint> readKeyPoints(const std::filesystem::path& file) {
  return parseKeyPoints(readFile(file, kMaxKeyFileBytes), file.string());
}

std::vector<KeyPoint> parseKeyPoints(std::string_view text, std::string_view file) {
  std::vector<KeyPoint> keys;
  bool first = true;
  forEachCsvRow(text, file, [&](const CsvRow& row) {
    const bool is_header = first && row.fields.front() == "name";
    first = false;
    if (is_header) return requireHeader(row);
    keys.push_back(keyPointOf(row));
  });
  return keys;
}

std::vector<KeyPoint> dissertationKeyPoints(const MeasuredDataChoice& choice) {
  // Tips of the spinous processes T5, T10 and L2 on the built-in body (published vertebral heights, docs/maps.md).
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
