// The table of forces by place and depth.
#include <fmt/format.h>

#include <algorithm>

#include "palpate/base/csv.h"
#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/text.h"
#include "palpate/measure/place_stiffness.h"
#include "palpate/tissue/fitting/table_columns.h"

namespace palpate::measure {

namespace {

constexpr std::size_t kMaxForceFileBytes = std::size_t{64} << 20;
constexpr NumberRange kForcePlacesMm{-1e5, 1e5};
constexpr NumberRange kDepthsMm{-1e3, 1e3};
constexpr NumberRange kForcesN{-1e4, 1e4};
/// Rows of one place agree about where it lies to this.
constexpr double kSamePlaceMm = 0.5;

std::size_t placeColumn(const CsvRow& header) {
  for (const char* name : {"place", "point"}) {
    if (const auto column = tissue::columnOf(header, name)) return *column;
  }
  return tissue::neededColumn(header, "name");
}

class ForceColumns {
 public:
  explicit ForceColumns(const CsvRow& header)
      : count_(header.fields.size()),
        place_(placeColumn(header)),
        depth_(tissue::neededColumn(header, "depth_mm")),
        force_(tissue::neededColumn(header, "force_n")),
        x_(tissue::columnOf(header, "x_mm")),
        y_(tissue::columnOf(header, "y_mm")),
        subject_(tissue::columnOf(header, "subject")),
        press_(tissue::columnOf(header, "press")) {}

  void add(const CsvRow& row, std::vector<PlaceCurve>& curves) const {
    tissue::checkFields(row, count_);
    PlaceCurve& curve = findOrAddCurve(row, curves);
    curve.curve.depth_mm.push_back(csvNumber(row, depth_, "depth_mm", kDepthsMm));
    curve.curve.force_n.push_back(csvNumber(row, force_, "force_n", kForcesN));
  }

 private:
  static std::string field(const CsvRow& row, const std::optional<std::size_t>& column) {
    return column ? std::string(row.fields[*column]) : std::string();
  }

  std::optional<Vec2> placeOf(const CsvRow& row) const {
    if (!x_ || !y_ || row.fields[*x_].empty()) return std::nullopt;
    return Vec2(csvNumber(row, *x_, "x_mm", kForcePlacesMm), csvNumber(row, *y_, "y_mm", kForcePlacesMm));
  }

  PlaceCurve& findOrAddCurve(const CsvRow& row, std::vector<PlaceCurve>& curves) const {
    PlaceCurve wanted{.place = field(row, place_), .at_mm = placeOf(row), .subject = field(row, subject_)};
    wanted.curve.name = field(row, press_);
    if (wanted.place.empty()) throw Error::atLine(row.file, row.line, "the place has no name");
    for (const PlaceCurve& curve : curves) {
      const bool apart = curve.place == wanted.place && curve.subject == wanted.subject && curve.at_mm &&
                         wanted.at_mm && (*curve.at_mm - *wanted.at_mm).norm() > kSamePlaceMm;
      if (apart) {
        throw Error::atLine(row.file, row.line,
                            fmt::format("{} is at {:g}, {:g} in an earlier row; expected the same place",
                                        oneLine(wanted.place), curve.at_mm->x(), curve.at_mm->y()));
      }
    }
    const auto same = [&](const PlaceCurve& curve) {
      return curve.place == wanted.place && curve.subject == wanted.subject && curve.curve.name == wanted.curve.name;
    };
    const auto found = std::ranges::find_if(curves, same);
    return found != curves.end() ? *found : curves.emplace_back(std::move(wanted));
  }

  std::size_t count_;
  std::size_t place_;
  std::size_t depth_;
  std::size_t force_;
  std::optional<std::size_t> x_;
  std::optional<std::size_t> y_;
  std::optional<std::size_t> subject_;
  std::optional<std::size_t> press_;
};

}  // namespace

std::vector<PlaceCurve> readPlaceCurves(const std::filesystem::path& file) {
  return parsePlaceCurves(readFile(file, kMaxForceFileBytes), file.string());
}

std::vector<PlaceCurve> parsePlaceCurves(std::string_view text, std::string_view file) {
  std::vector<PlaceCurve> curves;
  std::optional<ForceColumns> columns;
  forEachCsvRow(text, file, [&](const CsvRow& row) {
    if (!columns) {
      columns.emplace(row);
    } else {
      columns->add(row, curves);
    }
  });
  if (curves.empty()) throw Error::inFile(file, "has no rows; expected a header and one row per depth");
  return curves;
}

}  // namespace palpate::measure
