#include "palpate/measure/key_row.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "palpate/maps/key_points.h"

namespace palpate::measure {

namespace {

/// A tail so short is the half Gaussian.
constexpr double kMinInverseTail = 0.01;
constexpr std::size_t kLongestName = 64;

std::string field(double number) { return std::isfinite(number) ? fmt::format(",{:.6g}", number) : ","; }
std::string field(const std::optional<double>& number) { return number ? field(*number) : ","; }
/// An uncertainty needs no more digits.
std::string sdField(const Estimate& estimate) {
  return std::isfinite(estimate.sd) ? fmt::format(",{:.3g}", estimate.sd) : ",";
}

std::string measuredFields(const FieldFit& fit) {
  const double k = fit.inverse_tail.value;
  const bool has_4_mm = fit.at_4_mm.half_major_mm.value > 0.0;
  const Estimate none{.value = std::nan(""), .sd = std::nan("")};
  const Estimate& half_major_4 = has_4_mm ? fit.at_4_mm.half_major_mm : none;
  std::string row = field(half_major_4.value) + field(fit.peak_mm.value_or(none).value);
  // Other forms have a tail without P.
  row += fit.field.form == FieldForm::smooth && k > kMinInverseTail ? field(1.0 / k) : ",";
  row += field(fit.drift.length_mm) + field(fit.gaussian_rim_mm) + field(fit.drag_deg.value);
  row +=
      sdField(fit.at_2_mm.half_major_mm) + sdField(fit.at_2_mm.major_over_minor) + sdField(fit.at_2_mm.direction_deg);
  return row + sdField(half_major_4) + sdField(fit.peak_mm.value_or(none));
}

}  // namespace

std::string keyRowHeader() {
  std::string header = "name,x_mm,y_mm,half_major_mm,major_over_minor,direction_deg,stiffness_n_per_mm";
  for (const std::string_view column : maps::measuredColumns()) header += fmt::format(",{}", column);
  return header + "\n";
}

std::string keyRow(const Measurement& measurement, std::string_view name, const Vec2& place_mm) {
  if (!measurement.fit) return {};
  const KeyEllipse& ellipse = measurement.fit->at_2_mm;
  std::string row(name);
  row += field(place_mm.x()) + field(place_mm.y()) + field(ellipse.half_major_mm.value);
  row += field(ellipse.major_over_minor.value) + field(ellipse.direction_deg.value);
  return row + "," + measuredFields(*measurement.fit) + "\n";
}

std::string faultOfKeyName(std::string_view name) {
  if (name.empty()) return "is empty";
  if (name.size() > kLongestName) return fmt::format("is longer than {} bytes", kLongestName);
  const bool is_plain = std::none_of(name.begin(), name.end(), [](char letter) {
    return letter == ',' || letter == '#' || static_cast<unsigned char>(letter) < 0x20;
  });
  if (!is_plain) return "has a comma, a # or a control character, which a table does not hold";
  if (name.front() == ' ' || name.back() == ' ') return "begins or ends with a blank";
  if (name == "name") return "is what the header is known by";
  return {};
}

}  // namespace palpate::measure
