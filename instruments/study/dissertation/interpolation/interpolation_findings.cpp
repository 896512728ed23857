// Fills in the sentences of interpolation_findings.txt and the verdicts that the numbers decide.
#include "dissertation/interpolation/interpolation_findings.h"

#include <algorithm>
#include <cmath>

#include "dissertation/numbers/table_5_1.h"
#include "dissertation_findings_texts.h"

namespace palpate::study {

namespace {

constexpr double kExactMm = 1e-6;
// The widths whose errors are compared, and what counts as hardly: errors apart by less than a tenth.
constexpr double kNarrowest = 150.0;
constexpr double kHardly = 0.1;
// Twice what chance alone makes is taken for a difference.
constexpr double kBeyondChance = 2.0;
// An edge of the measured range may be missed by rounding.
constexpr double kRangeSlack = 1e-6;

std::size_t bestInterpolator(const InterpolatorErrors& errors) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < errors.size(); ++i) {
    if (errors[i].undetermined == 0 && errors[i].rms_mm < errors[best].rms_mm) best = i;
  }
  return best;
}

FindingValues radiusOrDiameter(const InterpolationResults& results) {
  const RadiusRange& range = results.figure_5_9;
  const auto holds = [&](double radius) { return radius >= range.from && radius <= range.to; };
  return {{"radii_mm", {range.from, range.to}},
          {"diameter", holds(0.5 * kTable51Diameter) && !holds(kTable51Diameter)},
          {"exact", results.furthest_from_key_mm < kExactMm},
          {"off_mm", results.furthest_from_key_mm}};
}

FindingValues predictedPlaces(const InterpolationResults& results) {
  const InterpolatorErrors& subjects = results.subjects;
  return {{"gri", subjects[1].rms_mm},     {"thin_plate", subjects[3].rms_mm},
          {"plane", subjects[4].rms_mm},   {"mean", subjects[0].rms_mm},
          {"scatter", results.scatter_mm}, {"best", kInterpolatorNames[bestInterpolator(subjects)]}};
}

FindingValues accuracyOfInterpolation(const InterpolationResults& results) {
  const double apart = std::abs(results.subjects[1].rms_mm - results.subjects[0].rms_mm);
  const auto& [least, most] = results.range_mm[1];
  const auto& [from, to] = results.measured_mm;
  const auto range = [](const std::pair<double, double>& both) -> FindingValues { return {both.first, both.second}; };
  return {{"too_few", apart < results.scatter_mm},
          {"apart", apart},
          {"scatter", results.scatter_mm},
          {"within", least >= from - kRangeSlack && most <= to + kRangeSlack},
          {"measured", range(results.measured_mm)},
          {"gri", range(results.range_mm[1])},
          {"thin_plate", range(results.range_mm[3])},
          {"plane", range(results.range_mm[4])}};
}

FindingValues effectOfWidth(const InterpolationResults& results) {
  Extent errors;
  for (std::size_t i = 0; i < results.radii.size(); ++i) {
    if (results.radii[i] >= kNarrowest) errors.add(results.subject_error_mm[i]);
  }
  return {{"hardly", errors.most <= (1.0 + kHardly) * errors.least},
          {"radii_mm", {kNarrowest, results.radii.back()}},
          {"errors_mm", errors},
          {"best_mm", *std::min_element(results.subject_error_mm.begin(), results.subject_error_mm.end())},
          {"best_radius_mm", bestRadius(results)},
          {"radius_mm", kEffectRadius},
          {"error_mm", results.subjects[1].rms_mm}};
}

FindingValues upDownValues(const InterpolationResults& results) {
  const double chance = results.expected_up_down_mm;
  return {{"rms_mm", results.up_down_mm},
          {"most_mm", results.up_down_most_mm},
          {"chance_mm", chance},
          {"verdict", results.up_down_mm > kBeyondChance * chance ? "beyond"
                      : results.up_down_mm > chance               ? "above"
                                                                  : "chance"}};
}

}  // namespace

double bestRadius(const InterpolationResults& results) {
  const auto best = std::min_element(results.subject_error_mm.begin(), results.subject_error_mm.end());
  return results.radii[static_cast<std::size_t>(best - results.subject_error_mm.begin())];
}

std::vector<std::string> interpolationFindings(const InterpolationResults& results) {
  const LeftOutErrors& quadratic = results.subjects[5];
  const auto cases = quadratic.undetermined + quadratic.predicted;
  return formatFindings(texts::interpolation_findings,
                        {{"diameter", radiusOrDiameter(results)},
                         {"predicted", predictedPlaces(results)},
                         {"accuracy", accuracyOfInterpolation(results)},
                         {"quadratic", {{"undetermined", quadratic.undetermined}, {"cases", cases}}},
                         {"width", effectOfWidth(results)},
                         {"up_down", upDownValues(results)}});
}

}  // namespace palpate::study
