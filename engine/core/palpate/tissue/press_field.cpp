// Fourth roots change nearly straight; with cubics down a layer some twenty rows are as good as eighty straight ones.
#include "palpate/tissue/press_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>

#include "palpate/base/error.h"
#include "palpate/base/number_range.h"
#include "palpate/tissue/layered_table.h"

namespace palpate::tissue {

namespace {

// Limits for an untrusted file.
constexpr std::size_t kMaxFieldRadii = 64;
constexpr std::size_t kMaxFieldRows = 200;
constexpr std::size_t kMaxFieldPresses = 32;
constexpr NumberRange kFieldPlaces{0.0, 10'000.0};
constexpr NumberRange kFieldPresses{0.0, 500.0, true};
constexpr NumberRange kFieldContact{0.0, 1000.0, true};
constexpr NumberRange kFieldExponent{-0.9, 10.0};
/// Fourth roots of densities: 10 is a material stretched some hundredfold.
constexpr NumberRange kFieldRoots{0.0, 10.0};
/// Rows are written with digits enough to be at a border.
constexpr double kAtBorderMm = 1e-6;

void inRange(const NumberRange& range, double value, std::string_view name) {
  if (range.holds(value)) return;
  throw Error(fmt::format("field: {} = {}", name, outOfRange(fmt::format("{}", value), range, {})));
}

void checkKnots(const std::vector<double>& knots, const NumberRange& range, std::size_t most, std::string_view name) {
  if (knots.size() < 2) throw Error(fmt::format("field: {}: at least two values are required", name));
  if (knots.size() > most) throw Error(fmt::format("field: {}: expected at most {} values", name, most));
  for (std::size_t i = 0; i < knots.size(); ++i) inRange(range, knots[i], fmt::format("{}, number {},", name, i + 1));
}

void checkIncrease(const std::vector<double>& knots, std::string_view name) {
  for (std::size_t i = 1; i < knots.size(); ++i) {
    if (knots[i] > knots[i - 1]) continue;
    throw Error(fmt::format("field: {} must increase, but {} follows {}", name, knots[i], knots[i - 1]));
  }
}

void checkRows(const PressField& field, const LayerStack& stack) {
  if (field.row_layers.size() != field.rows_mm.size()) {
    throw Error(
        fmt::format("field: row_layers has {} numbers for {} rows", field.row_layers.size(), field.rows_mm.size()));
  }
  double top = 0.0;
  std::size_t row = 0;
  for (std::size_t layer = 0; layer < stack.layers.size(); ++layer) {
    const double bottom = top + stack.layers[layer].thickness_mm;
    const std::size_t first = row;
    for (; row < field.rows_mm.size() && field.row_layers[row] == static_cast<int>(layer); ++row) {
      if (row == first || field.rows_mm[row] > field.rows_mm[row - 1]) continue;
      throw Error(fmt::format("field: rows_mm must increase within layer {}", layer + 1));
    }
    const bool reaches = row >= first + 2 && std::abs(field.rows_mm[first] - top) <= kAtBorderMm &&
                         std::abs(field.rows_mm[row - 1] - bottom) <= kAtBorderMm;
    if (!reaches) {
      throw Error(fmt::format("field: the rows of layer {} must go from its top at {} mm to its bottom at {} mm",
                              layer + 1, top, bottom));
    }
    top = bottom;
  }
  if (row != field.rows_mm.size()) throw Error("field: row_layers must number the layers from 0, from the skin down");
}

void checkRoots(const std::vector<float>& roots, std::size_t size, std::string_view name) {
  if (roots.size() != size) throw Error(fmt::format("field: {} has {} numbers, expected {}", name, roots.size(), size));
  for (std::size_t i = 0; i < roots.size(); ++i) {
    if (kFieldRoots.holds(roots[i])) continue;
    inRange(kFieldRoots, roots[i], fmt::format("{}, number {},", name, i + 1));
  }
}

}  // namespace

void check(const PressField& field, const LayerStack& stack) {
  if (stack.layers.empty()) throw Error("field: the table has no layers");
  checkKnots(field.radii_mm, kFieldPlaces, kMaxFieldRadii, "radii_mm");
  checkIncrease(field.radii_mm, "radii_mm");
  if (field.radii_mm.front() != 0.0) throw Error("field: radii_mm: the first must be 0");
  checkKnots(field.rows_mm, kFieldPlaces, kMaxFieldRows, "rows_mm");
  checkRows(field, stack);
  checkKnots(field.depths_mm, kFieldPresses, kMaxFieldPresses, "depths_mm");
  checkIncrease(field.depths_mm, "depths_mm");
  if (field.patterns.size() != field.depths_mm.size()) {
    throw Error(fmt::format("field: contact_radius_mm and pressure_exponent have {} numbers for {} depths",
                            field.patterns.size(), field.depths_mm.size()));
  }
  for (std::size_t i = 0; i < field.patterns.size(); ++i) {
    inRange(kFieldContact, field.patterns[i].contact_radius_mm, fmt::format("contact_radius_mm, number {},", i + 1));
    inRange(kFieldExponent, field.patterns[i].exponent, fmt::format("pressure_exponent, number {},", i + 1));
  }
  checkRoots(field.shear, field.size(), "shear");
  checkRoots(field.volume, field.size(), "volume");
}

FieldRow rowAt(const PressField& field, double depth_mm) noexcept {
  const std::vector<double>& rows = field.rows_mm;
  FieldRow row;
  if (!(depth_mm < rows.back())) return row;
  // Two rows are at a border: below it the deeper layer counts.
  const auto after = static_cast<std::size_t>(
      std::upper_bound(rows.begin() + 1, rows.end(), std::max(depth_mm, rows.front())) - rows.begin());
  const auto& layers = field.row_layers;
  const auto [first, last] = std::equal_range(layers.begin(), layers.end(), layers[after]);
  const auto top = static_cast<std::size_t>(first - layers.begin());
  const auto end = static_cast<std::size_t>(last - layers.begin());
  row.count = std::min(row.weight.size(), end - top);
  row.first = std::clamp(after < top + 2 ? top : after - 2, top, end - row.count);
  for (std::size_t i = 0; i < row.count; ++i) {
    row.weight[i] = 1.0;
    for (std::size_t j = 0; j < row.count; ++j) {
      if (i == j) continue;
      row.weight[i] *= (depth_mm - rows[row.first + j]) / (rows[row.first + i] - rows[row.first + j]);
    }
  }
  return row;
}

FieldPlace placeAt(const PressField& field, const FieldRow& row, double radius_mm) noexcept {
  const std::vector<double>& radii = field.radii_mm;
  FieldPlace place;
  if (row.count == 0 || !(radius_mm < radii.back())) return place;
  const auto after =
      static_cast<std::size_t>(std::upper_bound(radii.begin() + 1, radii.end() - 1, radius_mm) - radii.begin());
  const double out = std::max(0.0, (radius_mm - radii[after - 1]) / (radii[after] - radii[after - 1]));
  for (std::size_t i = 0; i < row.count; ++i) {
    const std::size_t near = ((row.first + i) * radii.size() + after - 1) * field.depths_mm.size();
    place.at[2 * i] = near;
    place.at[2 * i + 1] = near + field.depths_mm.size();
    place.weight[2 * i] = static_cast<float>(row.weight[i] * (1.0 - out));
    place.weight[2 * i + 1] = static_cast<float>(row.weight[i] * out);
  }
  place.count = 2 * row.count;
  return place;
}

StrainDensity densityAt(const PressField& field, const FieldPlace& place, std::size_t press) noexcept {
  const auto of = [&](const std::vector<float>& roots) {
    double root = 0.0;
    for (std::size_t i = 0; i < place.count; ++i) root += double{place.weight[i]} * double{roots[place.at[i] + press]};
    return root * root * root * root;
  };
  return {of(field.shear), of(field.volume)};
}

}  // namespace palpate::tissue
