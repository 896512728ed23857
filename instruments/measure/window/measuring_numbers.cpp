#include "measure/window/measuring_window.h"
#include "palpate/base/language.h"

#include <fmt/format.h>

#include <string_view>

namespace palpate::viewer {

namespace {

/// A larger one means that the direction is hardly determined.
constexpr double kVagueDeg = 10.0;

void addEllipse(const measure::KeyEllipse& ellipse, std::vector<MeasuredNumber>& numbers) {
  numbers.push_back({trf("half major at {:g} mm", ellipse.level_mm), withSd(ellipse.half_major_mm, 1, " mm")});
  numbers.push_back({trf("half minor at {:g} mm", ellipse.level_mm), withSd(ellipse.half_minor_mm, 1, " mm")});
}

std::string formatDirection(const measure::Estimate& direction) {
  return direction.sd > kVagueDeg ? tr("hardly determined") : withSd(direction, 1, "°");
}

}  // namespace

std::string findingText(const measure::Finding& finding) {
  constexpr std::string_view kOption = "--partial";
  const std::size_t at = finding.text.find(kOption);
  if (at == std::string::npos) return finding.text;
  return std::string(finding.text).replace(at, kOption.size(), fmt::format("\"{}\"", tr(kPartialBox)));
}

std::string withSd(const measure::Estimate& estimate, int digits, const char* unit) {
  return fmt::format("{:.{}f} ± {:.{}f}{}", estimate.value, digits, estimate.sd, digits, unit);
}

std::vector<MeasuredNumber> measuredNumbers(const measure::Measurement& measured) {
  if (!measured.fit) return {};
  const measure::FieldFit& fit = *measured.fit;
  std::vector<MeasuredNumber> numbers;
  addEllipse(fit.at_2_mm, numbers);
  numbers.push_back({tr("major over minor"), withSd(fit.at_2_mm.major_over_minor, 2, "")});
  numbers.push_back({tr("direction"), formatDirection(fit.at_2_mm.direction_deg)});
  addEllipse(fit.at_4_mm, numbers);
  numbers.push_back({tr("peak"), fit.peak_mm ? withSd(*fit.peak_mm, 1, " mm") : tr("not seen")});
  numbers.push_back({tr("dragged towards"), withSd(fit.drag_deg, 1, "°")});
  numbers.push_back({tr("tail 1/P"), withSd(fit.inverse_tail, 2, "")});
  numbers.push_back({tr("body moved"), fmt::format("{:.2f} mm", fit.drift.length_mm)});
  numbers.push_back({tr("misfit of a dot"), fmt::format("{:.2f} mm", fit.residual_rms_mm)});
  if (fit.gaussian_rim_mm) numbers.push_back({tr("rim of a Gaussian"), fmt::format("{:.0f} mm", *fit.gaussian_rim_mm)});
  numbers.push_back({tr("within the dots"), fmt::format("{:.0f} %", 100.0 * fit.inside_share)});
  numbers.push_back({tr("dots matched"), trf("{} of {}", measured.matched, measured.dots.size())});
  if (measured.contour && measured.contour->ellipse) {
    numbers.push_back(
        {tr(measured.contour->differs ? "contour alone (differs)" : "contour alone"),
         fmt::format("{:.1f} x {:.1f} mm", measured.contour->half_chord_mm, measured.contour->half_across_mm)});
  }
  return numbers;
}

}  // namespace palpate::viewer
