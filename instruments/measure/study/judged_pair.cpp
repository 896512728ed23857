#include "measure/study/judged_pair.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "palpate/measure/field/field_form.h"

namespace palpate::study {

using measure::Measurement;
using measure::SyntheticTruth;
using measure::TrueDot;

namespace {

/// A mark nearer than this to a true one is that one, mm.
constexpr double kSameMarkMm = 4.0;

double nearestDistance(const std::vector<Vec2>& places, const Vec2& place) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec2& other : places) least = std::min(least, (other - place).norm());
  return least;
}

const TrueDot* trueDotAt(const SyntheticTruth& truth, const Vec2& before_px) {
  const TrueDot* nearest = nullptr;
  double least = kSameMarkMm * truth.px_per_mm;
  for (const TrueDot& dot : truth.dots) {
    const double distance = (dot.before_px - before_px).norm();
    if (distance < least) nearest = &dot, least = distance;
  }
  return nearest;
}

double middleValue(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// From the measured frame of the skin to the true one. Both count the same stencil from different dots, so that whole
/// spacings lie between them.
Vec2 stepBetweenFrames(const measure::SyntheticCase& made, const SyntheticTruth& truth, const Measurement& measured) {
  std::vector<double> right;
  std::vector<double> up;
  for (const measure::MeasuredDot& dot : measured.dots) {
    const TrueDot* known = trueDotAt(truth, dot.before_px);
    if (known == nullptr) continue;
    right.push_back(known->skin_mm.x() - dot.skin_mm.x());
    up.push_back(known->skin_mm.y() - dot.skin_mm.y());
  }
  const Vec2 step(middleValue(right), middleValue(up));
  const double spacing = made.marks.spacing_mm;
  const Vec2 whole = ((step - made.marks.corner_mm) / spacing).array().round();
  return made.marks.corner_mm + spacing * whole;
}

/// An angle of an axis, which has no sense of direction, in [-90, 90).
double axisAngle(double degrees) { return std::remainder(degrees, 180.0); }

AxisError axisError(const measure::Estimate& measured, double truth) {
  if (truth <= 0.0 || measured.value <= 0.0) return {100.0, 0.0};
  return {100.0 * (measured.value / truth - 1.0), 100.0 * measured.sd / measured.value};
}

LevelErrors levelErrors(const measure::KeyEllipse& measured, const measure::KeyEllipse& truth) {
  return {axisError(measured.half_major_mm, truth.half_major_mm.value),
          axisError(measured.half_minor_mm, truth.half_minor_mm.value)};
}

void judgeDots(const SyntheticTruth& truth, const Measurement& measured, JudgedPair& judged) {
  std::vector<Vec2> before;
  for (const auto& dot : measured.grid.dots) before.push_back(dot.dot.place_px);
  std::size_t in_order = 0;
  for (const Vec2& place : before) {
    if (trueDotAt(truth, place) != nullptr)
      ++in_order;
    else if (nearestDistance(truth.strays_px, place) < kSameMarkMm * truth.px_per_mm)
      ++judged.strays_in_order;
  }
  for (const auto& dot : measured.grid.strays) before.push_back(dot.place_px);
  std::vector<Vec2> after;
  for (const auto& dot : measured.after_dots) after.push_back(dot.place_px);
  std::size_t found_before = 0;
  std::size_t found_after = 0;
  std::size_t visible = 0;
  for (const TrueDot& dot : truth.dots) {
    if (nearestDistance(before, dot.before_px) < kSameMarkMm * truth.px_per_mm) ++found_before;
    if (dot.covered > 0.0) continue;
    ++visible;
    if (nearestDistance(after, dot.after_px) < kSameMarkMm * truth.px_per_mm) ++found_after;
  }
  const auto share_of = [](std::size_t part, std::size_t all) {
    return all > 0 ? static_cast<double>(part) / static_cast<double>(all) : 0.0;
  };
  judged.found_before = share_of(found_before, truth.dots.size());
  judged.found_after = share_of(found_after, visible);
  judged.in_order = share_of(in_order, truth.dots.size());
}

/// Wrong is a match with another place than that of the same mark of the skin.
void judgeMatches(const SyntheticTruth& truth, const Measurement& measured, JudgedPair& judged) {
  double squares = 0.0;
  std::size_t right = 0;
  for (const measure::MeasuredDot& dot : measured.dots) {
    if (!dot.after_px) continue;
    ++judged.matched;
    const TrueDot* known = trueDotAt(truth, dot.before_px);
    if (known == nullptr) continue;  // a stray that was set between the dots moves with the skin too
    if ((known->after_px - *dot.after_px).norm() > 1.5 * kSameMarkMm * truth.px_per_mm) {
      ++judged.wrong_matches;
      continue;
    }
    squares += (dot.moved_mm - dot.drift_mm - known->moved_mm).squaredNorm();
    ++right;
  }
  if (right > 0) judged.displacement_rms_mm = std::sqrt(squares / static_cast<double>(right));
}

void judgeFit(const measure::SyntheticCase& made, const SyntheticTruth& truth, const Measurement& measured,
              JudgedPair& judged) {
  const measure::FieldFit& fit = *measured.fit;
  judged.fitted = true;
  judged.at_2_mm = levelErrors(fit.at_2_mm, truth.at_2_mm);
  judged.at_4_mm = levelErrors(fit.at_4_mm, truth.at_4_mm);
  judged.ratio_error = std::abs(fit.at_2_mm.major_over_minor.value - truth.at_2_mm.major_over_minor.value);
  judged.direction_error_deg = std::abs(axisAngle(fit.at_2_mm.direction_deg.value - truth.at_2_mm.direction_deg.value));
  judged.direction_sd_deg = fit.at_2_mm.direction_deg.sd;
  const Vec2 contact = Vec2(fit.contact_x_mm.value, fit.contact_y_mm.value) + stepBetweenFrames(made, truth, measured);
  judged.contact_error_mm = (contact - truth.field.contact_mm).norm();
  judged.contact_sd_mm = std::hypot(fit.contact_x_mm.sd, fit.contact_y_mm.sd);
  judged.drag_error_deg = std::abs(std::remainder(fit.drag_deg.value - truth.drag_deg, 360.0));
  const double peak = truth.field.peak_mm.norm();
  judged.peak_stated = fit.peak_mm.has_value();
  if (fit.peak_mm) judged.peak = axisError(*fit.peak_mm, peak);
  judged.form = measure::nameOf(fit.field.form);
  judged.form_share = fit.forms.empty() ? 1.0 : fit.forms.front().share;
  judged.residual_rms_mm = fit.residual_rms_mm;
  judged.residual_pattern = fit.residual_pattern;
  judged.drift_in_sd = fit.drift.in_sd;
}

}  // namespace

double AxisError::inSds() const {
  return stated_percent > 0.0 ? std::abs(percent) / stated_percent : std::numeric_limits<double>::infinity();
}

double LevelErrors::worsePercent() const { return std::max(std::abs(major.percent), std::abs(minor.percent)); }
double LevelErrors::worseInSds() const { return std::max(major.inSds(), minor.inSds()); }

JudgedPair judgePair(const measure::SyntheticCase& made, const SyntheticTruth& truth, const Measurement& measured) {
  JudgedPair judged;
  judged.seed = made.seed;
  judged.family = made.press.family;
  judged.true_ratio = truth.at_2_mm.major_over_minor.value;
  judged.true_half_major_mm = truth.at_2_mm.half_major_mm.value;
  judged.accepted = measured.accepted();
  judged.seconds = measured.seconds;
  for (const measure::Finding& finding : measured.findings) {
    const bool refused = finding.severity == measure::Severity::refusal;
    if (refused && judged.refusals.empty()) judged.reason = finding.text;
    (refused ? judged.refusals : judged.warnings).push_back(finding.code);
  }
  judgeDots(truth, measured, judged);
  judgeMatches(truth, measured, judged);
  if (!measured.fit) return judged;
  judgeFit(made, truth, measured, judged);
  judged.has_contour = measured.contour && measured.contour->half_chord_mm > 0.0;
  if (judged.has_contour && judged.true_half_major_mm > 0.0) {
    judged.chord_percent = 100.0 * (measured.contour->half_chord_mm / judged.true_half_major_mm - 1.0);
    judged.chord_direction_deg = std::abs(axisAngle(measured.contour->chord_deg - truth.at_2_mm.direction_deg.value));
  }
  return judged;
}

}  // namespace palpate::study
