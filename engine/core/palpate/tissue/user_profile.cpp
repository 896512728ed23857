// The table is read and checked row by row; between rows runs a cubic Hermite curve whose slopes are harmonic means.
//
// Based on: Fritsch, Butland, "A method for constructing local monotone piecewise cubic interpolants" (1984).
#include "palpate/tissue/user_profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "palpate/base/csv.h"
#include "palpate/base/error.h"
#include "palpate/base/text.h"

namespace palpate::tissue {

namespace {

/// A hundred thousand rows fit.
constexpr std::size_t kMaxProfileBytes = 1'000'000;

/// A profile is 1 in the middle and 0 at the rim; bulges and dents between them stay within this range.
constexpr NumberRange kKnotValues{-100.0, 100.0};

/// The fault of a row, given the one before it; nothing if the row is valid.
std::optional<std::string> findFault(const ProfileKnot& knot, const ProfileKnot* before) {
  if (!std::isfinite(knot.q) || !std::isfinite(knot.value)) return "q and value must be finite";
  if (!kKnotValues.holds(knot.value)) return "value = " + outOfRange(fmt::format("{}", knot.value), kKnotValues);
  if (before == nullptr) {
    if (knot.q != 0.0) return fmt::format("the first q must be 0, not {}", knot.q);
    if (knot.value != 1.0) return fmt::format("the value at q = 0 must be 1, not {}", knot.value);
    return std::nullopt;
  }
  if (!(knot.q > before->q)) return fmt::format("q must ascend: {} after {}", knot.q, before->q);
  if (knot.q > 1.0) return fmt::format("q must not go beyond 1, the rim; it is {}", knot.q);
  return std::nullopt;
}

std::optional<std::string> faultOfLast(const ProfileKnot& last) {
  if (last.q != 1.0) return fmt::format("the last q must be 1, not {}", last.q);
  if (last.value != 0.0) return fmt::format("the value at q = 1 must be 0, not {}", last.value);
  return std::nullopt;
}

ProfileKnot parseKnot(const CsvRow& row) {
  if (row.fields.size() != 2) throw Error::atLine(row.file, row.line, "expected a row q,value");
  return {csvNumber(row, 0, "q"), csvNumber(row, 1, "value", kKnotValues)};
}

double intervalWidth(std::span<const ProfileKnot> knots, std::size_t interval) {
  return knots[interval + 1].q - knots[interval].q;
}

double riseOf(std::span<const ProfileKnot> knots, std::size_t interval) {
  return (knots[interval + 1].value - knots[interval].value) / intervalWidth(knots, interval);
}

/// Weighted harmonic mean of the slopes on both sides; 0 where the curve turns (Fritsch and Butland).
double innerSlope(std::span<const ProfileKnot> knots, std::size_t i) {
  const double left = riseOf(knots, i - 1);
  const double right = riseOf(knots, i);
  if (left * right <= 0.0) return 0.0;
  const double near_left = 2.0 * intervalWidth(knots, i) + intervalWidth(knots, i - 1);
  const double near_right = intervalWidth(knots, i) + 2.0 * intervalWidth(knots, i - 1);
  return (near_left + near_right) / (near_left / left + near_right / right);
}

}  // namespace

std::vector<ProfileKnot> parseProfileKnots(std::string_view text, std::string_view file) {
  std::vector<ProfileKnot> knots;
  std::size_t last_line = 0;
  bool may_be_header = true;
  forEachCsvRow(text, file, [&](const CsvRow& row) {
    const bool header = may_be_header && looksLikeCsvHeader(row);
    may_be_header = false;
    if (header) return;
    const ProfileKnot knot = parseKnot(row);
    if (const auto fault = findFault(knot, knots.empty() ? nullptr : &knots.back())) {
      throw Error::atLine(file, row.line, *fault);
    }
    knots.push_back(knot);
    last_line = row.line;
  });
  if (knots.size() < 2) throw Error::inFile(file, "a profile requires at least two rows q,value");
  if (const auto fault = faultOfLast(knots.back())) throw Error::atLine(file, last_line, *fault);
  return knots;
}

std::vector<ProfileKnot> readProfileKnots(const std::filesystem::path& file) {
  return parseProfileKnots(readFile(file, kMaxProfileBytes), file.string());
}

void checkProfileKnots(std::span<const ProfileKnot> knots) {
  if (knots.size() < 2) throw Error("profile: at least two rows are required");
  for (std::size_t i = 0; i < knots.size(); ++i) {
    if (const auto fault = findFault(knots[i], i == 0 ? nullptr : &knots[i - 1])) {
      throw Error(fmt::format("profile, row {}: {}", i + 1, *fault));
    }
  }
  if (const auto fault = faultOfLast(knots.back())) throw Error("profile: " + *fault);
}

std::vector<double> knotSlopes(std::span<const ProfileKnot> knots, UserInterpolation interpolation) {
  std::vector<double> slopes(knots.size(), 0.0);
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    const bool smooth = interpolation == UserInterpolation::monotone_cubic && i > 0;
    slopes[i] = smooth ? innerSlope(knots, i) : riseOf(knots, i);
  }
  if (interpolation == UserInterpolation::linear) return slopes;
  // Skin is level under a round finger and at the rim (Table 4.2); with two rows this is the smoothstep.
  slopes.front() = slopes.back() = 0.0;
  return slopes;
}

ProfilePoint interpolatedKnots(std::span<const ProfileKnot> knots, std::span<const double> slopes,
                               UserInterpolation interpolation, double q) noexcept {
  const auto beyond =
      std::upper_bound(knots.begin() + 1, knots.end() - 1, q, [](double at, const auto& knot) { return at < knot.q; });
  const auto i = static_cast<std::size_t>(beyond - knots.begin()) - 1;
  const double width = intervalWidth(knots, i);
  const double t = (q - knots[i].q) / width;
  const double rise = knots[i + 1].value - knots[i].value;
  if (interpolation == UserInterpolation::linear) return {knots[i].value + t * rise, slopes[i]};
  // Cubic Hermite: value = v0 + t (m0 + t (c2 + t c3)) with m = slope times width.
  const double m0 = slopes[i] * width;
  const double m1 = slopes[i + 1] * width;
  const double c2 = 3.0 * rise - 2.0 * m0 - m1;
  const double c3 = m0 + m1 - 2.0 * rise;
  return {knots[i].value + t * (m0 + t * (c2 + t * c3)), (m0 + t * (2.0 * c2 + 3.0 * t * c3)) / width};
}

}  // namespace palpate::tissue
