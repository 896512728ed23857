// The table of contours, name,x_mm,y_mm and a radius a direction, and the blend of their logarithms at a place.
//
// Based on: Ji, dissertation 2008, section 5.2 (GRI); contours in place of ellipses are our own.
#include "palpate/maps/contour_map.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "palpate/base/csv.h"
#include "palpate/base/elementary.h"
#include "palpate/base/error.h"
#include "palpate/base/text.h"
#include "palpate/maps/gaussian_interpolation.h"

namespace palpate::maps {

namespace {

constexpr std::size_t kColumnsBefore = 3;  // name, x_mm, y_mm
/// 64 MiB: more than a hundred thousand rows; anything longer is not a table of measurements.
constexpr std::size_t kMaxFileBytes = std::size_t{64} << 20;
constexpr NumberRange kRadiiMm{1e-3, 1e4};  // a micrometre to ten metres; what is beyond is a wrong unit
constexpr NumberRange kContourPlacesMm{-1e5, 1e5};

std::string header(std::size_t radii) {
  std::string text = "name,x_mm,y_mm";
  for (std::size_t i = 0; i < radii; ++i) fmt::format_to(std::back_inserter(text), ",r{}_mm", i);
  return text;
}

/// Number of radii of the row. `wanted` is that of the rows before, 0 for the first one.
std::size_t countRadii(const CsvRow& row, std::size_t wanted) {
  const std::size_t radii = row.fields.size() - std::min(row.fields.size(), kColumnsBefore);
  if (radii < kMinContourRadii || radii > kMaxContourRadii) {
    throw Error::atLine(row.file, row.line,
                        fmt::format("expected name,x_mm,y_mm and {} to {} radii, found {} fields", kMinContourRadii,
                                    kMaxContourRadii, row.fields.size()));
  }
  if (wanted == 0 || radii == wanted) return radii;
  throw Error::atLine(row.file, row.line, fmt::format("{} radii, but the rows before it have {}", radii, wanted));
}

/// The columns carry the units in their names, so a header that differs is not ours.
void requireHeader(const CsvRow& row, std::size_t radii) {
  const std::string expected = header(radii);
  if (fmt::format("{}", fmt::join(row.fields, ",")) == expected) return;
  throw unexpectedHeader(row, expected);
}

double radiusOf(const CsvRow& row, std::size_t i) {
  return csvNumber(row, kColumnsBefore + i, fmt::format("r{}_mm", i), kRadiiMm);
}

ContourPoint parseContourPoint(const CsvRow& row, std::size_t radii) {
  std::vector<double> radii_mm;
  for (std::size_t i = 0; i < radii; ++i) radii_mm.push_back(radiusOf(row, i));
  return {std::string(row.fields[0]),
          {csvNumber(row, 1, "x_mm", kContourPlacesMm), csvNumber(row, 2, "y_mm", kContourPlacesMm)},
          contourOf(radii_mm)};
}

/// All logarithms of a contour at once. Unused ones are carried along: a fixed size needs no allocation.
using LogRadii = Eigen::Matrix<double, static_cast<int>(kMaxContourRadii), 1>;

}  // namespace

std::vector<ContourPoint> readContourPoints(const std::filesystem::path& file) {
  return parseContourPoints(readFile(file, kMaxFileBytes), file.string());
}

std::vector<ContourPoint> parseContourPoints(std::string_view text, std::string_view file) {
  std::vector<ContourPoint> points;
  std::size_t radii = 0;
  forEachCsvRow(text, file, [&](const CsvRow& row) {
    const bool first = radii == 0;
    radii = countRadii(row, radii);
    if (first && row.fields.front() == "name") return requireHeader(row, radii);
    points.push_back(parseContourPoint(row, radii));
  });
  return points;
}

std::vector<ContourPoint> contourPointsOf(std::span<const KeyPoint> keys, std::size_t radii) {
  std::vector<ContourPoint> points;
  for (const KeyPoint& key : keys) {
    if (key.ellipse.half_major_mm > 0.0) points.push_back({key.name, key.position_mm, contourOf(key.ellipse, radii)});
  }
  return points;
}

PolarContourMap::PolarContourMap(std::span<const ContourPoint> points, const EllipseMapSettings& settings)
    : log_basic_radius_(elementary::log(settings.basic_radius_mm)), effect_radius_mm_(settings.effect_radius_mm) {
  if (!(settings.basic_radius_mm > 0.0) || !std::isfinite(settings.basic_radius_mm)) {
    throw Error("contour map: the basic radius must be above 0 mm");
  }
  std::copy_if(points.begin(), points.end(), std::back_inserter(points_),
               [](const auto& p) { return p.contour.count; });
  if (!points_.empty()) radii_ = points_.front().contour.count;
  const auto fits = [&](const ContourPoint& point) { return point.contour.count == radii_; };
  if (!std::all_of(points_.begin(), points_.end(), fits)) {
    throw Error("contour map: every contour needs the same number of radii");
  }
}

PolarContour PolarContourMap::at(double x_mm, double y_mm) const noexcept {
  GaussianBlend<LogRadii> blend(LogRadii::Constant(log_basic_radius_));
  for (const ContourPoint& point : points_) {
    const double level = effectLevel((Vec2(x_mm, y_mm) - point.position_mm).norm(), effect_radius_mm_);
    if (level > 0.0) blend.add(level, Eigen::Map<const LogRadii>(point.contour.log_radii.data()));
  }
  PolarContour contour;
  contour.count = radii_;
  Eigen::Map<LogRadii>(contour.log_radii.data()) = blend.result();
  return contour;
}

SurfaceContour PolarContourMap::on(const Vec3& point, const Vec3& normal) const noexcept {
  return contourOnSurface(at(point.x(), point.y()), normal);
}

}  // namespace palpate::maps
