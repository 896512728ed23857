// The limits were chosen on synthetic pairs, good and corrupted ones (docs/explanation/measuring.md): none that
// is far off may pass.
#include "palpate/measure/field_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "palpate/measure/field/field_form.h"
#include "palpate/measure/skin_chart.h"

namespace palpate::measure {

namespace {

constexpr std::size_t kEnoughDotsInOrder = 60;
constexpr double kMaxRollDeg = 35.0;        // at 45 the upright is undecidable
constexpr double kMaxIrregularityMm = 3.0;  // marks of a stencil give 0.5 to 1.2, a free hand 2 to 2.6
constexpr double kMinMatched = 0.6;
constexpr double kMaxResidualMm = 0.9;
constexpr double kUsualResidualMm = 0.3;
constexpr double kMinPeakMm = 4.0;
constexpr double kMaxAxisSd = 0.08;     // relative sd of a half axis; includes how much the forms differ
constexpr double kUsualAxisSd = 0.055;  // more is warned of
constexpr double kMinInside = 0.6;      // share of the ellipse within the dots
constexpr double kSureShare = 0.8;      // share of the likeliest form: below it others explain the dots about as well
constexpr double kUsualPattern = 0.25;  // neighbours' correlation; by chance 0, drift lowers it
constexpr double kPatternedResidualMm = 0.15;
constexpr double kMaxDriftSds = 2.0;
constexpr double kHardlyDeterminedDeg = 10.0;
constexpr double kNearlyRound = 1.15;  // major over minor: below it the direction is hardly determined whatever is seen
constexpr double kContactSds = 3.0;
constexpr double kMinContactSdMm = 1.0;        // no user clicks better
constexpr std::size_t kSuspiciousVisible = 4;  // sites that only the second picture shows

Finding refusal(std::string code, std::string text) { return {Severity::refusal, std::move(code), std::move(text)}; }
Finding warning(std::string code, std::string text) { return {Severity::warning, std::move(code), std::move(text)}; }

/// Whether there are dots on all sides, as far as two spacings away: a missing dot leaves a hole in the chart's cover.
bool isAmongDots(const Measurement& m, const Vec2& place_mm) {
  int sides = 0;
  for (int i = 0; i < 8; ++i) {
    const double angle = 0.25 * std::numbers::pi * i;
    const Vec2 outward = m.settings.spacing_mm * Vec2(std::cos(angle), std::sin(angle));
    sides += static_cast<int>(m.chart->covers(place_mm) || m.chart->covers(place_mm + 0.7 * outward) ||
                              m.chart->covers(place_mm + 1.4 * outward) || m.chart->covers(place_mm + 2.0 * outward));
  }
  return sides == 8;
}

void judgeDrift(const Measurement& m, std::vector<Finding>& findings) {
  const Drift& drift = m.fit->drift;
  if (drift.in_sd <= kMaxDriftSds) return;
  findings.push_back(refusal(
      "moved",
      fmt::format("The body (or the camera) moved between the pictures: {:.1f} mm, turned {:.2f} degrees, {:+.2f} % in "
                  "size, more than a drift of {} mm allows. Hold the breath and repeat, or give --drift-mm; then the "
                  "half axes are less sure.",
                  drift.length_mm, drift.turn_deg, drift.scale_percent, m.settings.drift_mm)));
}

void judgeEllipse(const Measurement& m, std::vector<Finding>& findings) {
  const FieldFit& fit = *m.fit;
  const KeyEllipse& key = fit.at_2_mm;
  const double peak_mm = fit.field.peak_mm.norm();
  if (peak_mm < kMinPeakMm) {
    findings.push_back(
        refusal("not_pressed", fmt::format("Nothing was dragged: the skin moved {:.1f} mm at most, and at "
                                           "least {} mm are needed. Press and drag farther.",
                                           peak_mm, kMinPeakMm)));
    return;
  }
  const double sd = std::max(key.half_major_mm.sd / std::max(key.half_major_mm.value, 1e-9),
                             key.half_minor_mm.sd / std::max(key.half_minor_mm.value, 1e-9));
  if (!(sd <= kMaxAxisSd) && !m.settings.partial) {
    findings.push_back(
        refusal("unsure", fmt::format("A half axis is known to {:.1f} % only (the limit is {:g} %). Drag farther, hold "
                                      "the breath, use more dots.",
                                      100.0 * sd, 100.0 * kMaxAxisSd)));
  } else if (!(sd <= kUsualAxisSd)) {
    findings.push_back(warning("imprecise", fmt::format("A half axis is known to {:.1f} % only.", 100.0 * sd)));
  }
  if (fit.inside_share < kMinInside && !m.settings.partial)
    findings.push_back(refusal("leaves_dots", fmt::format("Only {:.0f} % of the ellipse is within the dots. Mark more "
                                                          "rows around the contact, or allow it with --partial.",
                                                          100.0 * fit.inside_share)));
  if (!isAmongDots(m, {fit.contact_x_mm.value, fit.contact_y_mm.value}))
    findings.push_back(
        refusal("contact_outside",
                "The contact found is outside the dots. Press between dots, at least two rows from the rim."));
  if (key.direction_deg.sd > kHardlyDeterminedDeg) {
    const double ratio = key.major_over_minor.value;
    findings.push_back(warning(
        "direction_unsure",
        fmt::format("The direction is hardly determined (sd {:.0f} degrees): {} (ratio {:.2f}).", key.direction_deg.sd,
                    ratio < kNearlyRound ? "the ellipse is nearly a circle" : "the dots say too little of it", ratio)));
  }
}

void judgeResiduals(const Measurement& m, std::vector<Finding>& findings) {
  const double rms = m.fit->residual_rms_mm;
  if (rms > kMaxResidualMm) {
    findings.push_back(
        refusal("misfit", fmt::format("The motion of the dots is not that of dragged skin: {:.2f} mm of it "
                                      "stay unexplained (at most {} mm). Are both pictures of one person, "
                                      "one place and one camera?",
                                      rms, kMaxResidualMm)));
  } else if (rms > kUsualResidualMm || (rms > kPatternedResidualMm && m.fit->residual_pattern > kUsualPattern)) {
    findings.push_back(
        warning("form", fmt::format("The field is not of any fitted form: {:.2f} mm stay unexplained "
                                    "(usually below {} mm), and neighbouring dots differ alike ({:.2f}). "
                                    "The axes may be off by more than their sd.",
                                    rms, kUsualResidualMm, m.fit->residual_pattern)));
  }
}

std::string describeFormShares(const FieldFit& fit) {
  std::string words;
  for (const FormShare& form : fit.forms)
    words += fmt::format("{}{} {:.0f} %", words.empty() ? "" : ", ", nameOf(form.form), 100.0 * form.share);
  return words;
}

void judgeForms(const Measurement& m, std::vector<Finding>& findings) {
  const FieldFit& fit = *m.fit;
  if (!fit.forms.empty() && fit.forms.front().share < kSureShare)
    findings.push_back(warning("forms", fmt::format("Several forms of the field explain the dots about equally well "
                                                    "({}); their differences are included in the sd of axes and peak.",
                                                    describeFormShares(fit))));
  if (!fit.peak_mm)
    findings.push_back(warning("no_peak",
                               "No peak is stated: no dot is in the core of the field. Mark dots closer together "
                               "around the contact, or measure how far the tip of the stick moved."));
}

void judgeContact(const Measurement& m, std::vector<Finding>& findings) {
  if (!m.settings.contact_px) return;
  const FieldFit& fit = *m.fit;
  const Vec2 marked = m.chart->skinAt(*m.settings.contact_px);
  const Vec2 off = marked - Vec2(fit.contact_x_mm.value, fit.contact_y_mm.value);
  const double sd = std::max(kMinContactSdMm, std::hypot(fit.contact_x_mm.sd, fit.contact_y_mm.sd));
  if (off.norm() <= kContactSds * sd) return;
  findings.push_back(warning(
      "contact_differs",
      fmt::format(
          "The contact that was marked lies {:.1f} mm from the middle of the field: skin that bunches before the "
          "stick and stretches behind it does that, and so does a mark on the tip in the second picture (the "
          "contact belongs into the first). Axes and direction are not touched by it.",
          off.norm())));
}

void judgeOrder(const Measurement& m, std::size_t newly_visible, std::vector<Finding>& findings) {
  const std::size_t hidden = m.dots.size() - m.matched;
  if (newly_visible < kSuspiciousVisible || newly_visible <= hidden) return;
  findings.push_back(
      refusal("swapped", fmt::format("The first picture hides {} dots that the second shows, and the second "
                                     "only {}: the stick seems to be in the first. Give the pictures in "
                                     "the order before, after.",
                                     newly_visible, hidden)));
}

}  // namespace

bool Measurement::accepted() const {
  return fit && std::none_of(findings.begin(), findings.end(),
                             [](const Finding& finding) { return finding.severity == Severity::refusal; });
}

std::vector<Finding> judgeGrid(const DotGrid& grid, const MeasureSettings& settings, const char* which) {
  std::vector<Finding> findings;
  const std::size_t count = grid.dots.size();
  const std::size_t strays = grid.strays.size();
  if (count < kEnoughDotsInOrder) {
    findings.push_back(refusal(
        "few_dots",
        fmt::format(
            "The {} picture shows {} dots in the grid and {} other marks; {} in the grid are needed. Is the ink red, "
            "blue or green (black is not detected), the light sufficient, the whole grid in the frame?",
            which, count, strays, kEnoughDotsInOrder)));
  }
  if (count < kMinDotsInOrder) return findings;
  if (std::abs(grid.roll_deg) > kMaxRollDeg)
    findings.push_back(refusal("roll", fmt::format("The grid is turned by {:.0f} degrees in the picture: the direction "
                                                   "of the head is unknown. Turn the camera along the body.",
                                                   grid.roll_deg)));
  const double irregularity_mm = grid.irregularity * settings.spacing_mm;
  if (irregularity_mm > kMaxIrregularityMm)
    findings.push_back(
        refusal("irregular", fmt::format("The marks are irregular: {:.1f} mm from where their neighbours "
                                         "have them (at most {} mm). Use a stencil.",
                                         irregularity_mm, kMaxIrregularityMm)));
  return findings;
}

std::vector<Finding> judgeFit(const Measurement& m, std::size_t newly_visible) {
  std::vector<Finding> findings;
  const double share = static_cast<double>(m.matched) / static_cast<double>(std::max<std::size_t>(1, m.dots.size()));
  if (share < kMinMatched)
    findings.push_back(refusal(
        "few_matched", fmt::format("Only {:.0f} % of the dots were found again in the second picture ({:.0f} % are "
                                   "needed). Keep hand and stick beside the grid, and do not change the light.",
                                   100.0 * share, 100.0 * kMinMatched)));
  if (!m.fit) return findings;
  judgeDrift(m, findings);
  judgeEllipse(m, findings);
  judgeResiduals(m, findings);
  judgeForms(m, findings);
  judgeContact(m, findings);
  judgeOrder(m, newly_visible, findings);
  return findings;
}

}  // namespace palpate::measure
