// Columns are found by their names, fields read into the members that belong to them.
//
// Based on: Ji, dissertation 2008, Appendix C (the table of full axes in cm). Own otherwise.
#include "palpate/measure/press_table.h"

#include <fmt/format.h>

#include <array>

#include "palpate/base/csv.h"
#include "palpate/base/error.h"
#include "palpate/base/text.h"
#include "palpate/tissue/fitting/table_columns.h"

namespace palpate::measure {

namespace {

constexpr std::size_t kMaxPressFileBytes = std::size_t{64} << 20;
constexpr double kHalfMmPerCm = 5.0;  // E16
constexpr NumberRange kPlacesMm{-1e5, 1e5};
constexpr NumberRange kSizesMm{1e-3, 1e4};
constexpr NumberRange kSizesCm{1e-4, 1e3};
constexpr NumberRange kRatios{1e-3, 1e3};
constexpr NumberRange kDegrees{-360.0, 360.0};
constexpr NumberRange kSds{0.0, 1e4};
constexpr NumberRange kStiffnesses{0.0, 1000.0};

/// A number that a row may leave out.
struct WantedNumber {
  std::string_view column;
  NumberRange range;
  std::optional<double> PressRow::*member;
};
constexpr std::array kWanted = {
    WantedNumber{"drag_deg", kDegrees, &PressRow::drag_deg},
    WantedNumber{"sd_half_major_mm", kSds, &PressRow::sd_half_major_mm},
    WantedNumber{"sd_ratio", kSds, &PressRow::sd_ratio},
    WantedNumber{"sd_direction_deg", kSds, &PressRow::sd_direction_deg},
    WantedNumber{"half_major_4_mm", kSizesMm, &PressRow::half_major_4_mm},
    WantedNumber{"peak_mm", kSizesMm, &PressRow::peak_mm},
    WantedNumber{"stiffness_n_per_mm", kStiffnesses, &PressRow::stiffness_n_per_mm},
};

/// Where the header has what.
class PressColumns {
 public:
  explicit PressColumns(const CsvRow& header)
      : count_(header.fields.size()),
        name_(tissue::columnOf(header, "point") ? *tissue::columnOf(header, "point")
                                                : tissue::neededColumn(header, "name")),
        x_(tissue::neededColumn(header, "x_mm")),
        y_(tissue::neededColumn(header, "y_mm")),
        direction_(tissue::neededColumn(header, "direction_deg")),
        full_axes_(tissue::columnOf(header, "major_cm").has_value()),
        size_(tissue::neededColumn(header, full_axes_ ? "major_cm" : "half_major_mm")),
        across_(tissue::neededColumn(header, full_axes_ ? "minor_cm" : "major_over_minor")),
        subject_(tissue::columnOf(header, "subject")) {
    for (const WantedNumber& wanted : kWanted) wanted_.push_back(tissue::columnOf(header, wanted.column));
  }

  PressRow readPress(const CsvRow& row) const {
    tissue::checkFields(row, count_);
    PressRow press{.point = std::string(row.fields[name_]),
                   .place_mm = {csvNumber(row, x_, "x_mm", kPlacesMm), csvNumber(row, y_, "y_mm", kPlacesMm)},
                   .direction_deg = csvNumber(row, direction_, "direction_deg", kDegrees)};
    if (press.point.empty()) throw Error::atLine(row.file, row.line, "the point has no name");
    readSize(row, press);
    if (subject_) press.subject = row.fields[*subject_];
    for (std::size_t i = 0; i < kWanted.size(); ++i) {
      if (!wanted_[i] || row.fields[*wanted_[i]].empty()) continue;
      press.*kWanted.at(i).member = csvNumber(row, *wanted_[i], kWanted.at(i).column, kWanted.at(i).range);
    }
    return press;
  }

 private:
  void readSize(const CsvRow& row, PressRow& press) const {
    if (full_axes_) {
      const double major_cm = csvNumber(row, size_, "major_cm", kSizesCm);
      press.half_major_mm = major_cm * kHalfMmPerCm;
      press.major_over_minor = major_cm / csvNumber(row, across_, "minor_cm", kSizesCm);
    } else {
      press.half_major_mm = csvNumber(row, size_, "half_major_mm", kSizesMm);
      press.major_over_minor = csvNumber(row, across_, "major_over_minor", kRatios);
    }
  }

  std::size_t count_;
  std::size_t name_;
  std::size_t x_;
  std::size_t y_;
  std::size_t direction_;
  bool full_axes_;
  std::size_t size_;
  std::size_t across_;
  std::optional<std::size_t> subject_;
  std::vector<std::optional<std::size_t>> wanted_;
};

}  // namespace

std::vector<PressRow> readPresses(const std::filesystem::path& file) {
  return parsePresses(readFile(file, kMaxPressFileBytes), file.string());
}

std::vector<PressRow> parsePresses(std::string_view text, std::string_view file) {
  std::vector<PressRow> presses;
  std::optional<PressColumns> columns;
  forEachCsvRow(text, file, [&](const CsvRow& row) {
    if (!columns) {
      columns.emplace(row);
    } else {
      presses.push_back(columns->readPress(row));
    }
  });
  if (presses.empty()) throw Error::inFile(file, "has no presses; expected a header and one row per press");
  return presses;
}

}  // namespace palpate::measure
