// Each verdict is decided by the numbers that stand beside it; where they do not decide, none is given.
#include "dissertation/interpolation/interpolation_findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "dissertation/numbers/table_5_1.h"

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

std::string diameterFinding(const InterpolationResults& results) {
  const RadiusRange& range = results.figure_5_9;
  const auto holds = [&](double radius) { return radius >= range.from && radius <= range.to; };
  const bool diameter = holds(0.5 * kTable51Diameter) && !holds(kTable51Diameter);
  return fmt::format(
      "(5.7) misses its keys and gives both printed numbers, 115 and 112, only for effect radii from {:.0f} to {:.0f} "
      "mm: "
      "{} (E28). (5.16) at the keys of Table 5.1 {} for e = 100, 200 and 400 (off by {:.1g} mm at most).",
      range.from, range.to,
      diameter ? "the printed 400 is the diameter"
               : "that does not tell whether the printed 400 is a radius or a diameter",
      results.furthest_from_key_mm < kExactMm ? "gives 120" : "does NOT give 120", results.furthest_from_key_mm);
}

std::string predictedFinding(const InterpolationResults& results) {
  const InterpolatorErrors& subjects = results.subjects;
  const double engine = subjects[1].rms_mm;
  return fmt::format(
      "To be exact at the keys is one thing, the places between are another. Left out and predicted from the others, a "
      "subject's boundary is missed by {:.0f} mm by the engine's GRI, {:.0f} by the thin plate, {:.0f} by a plane and "
      "{:.0f} by the plain mean. Two subjects at the same point differ by {:.0f} mm. Best here: {}.",
      engine, subjects[3].rms_mm, subjects[4].rms_mm, subjects[0].rms_mm, results.scatter_mm,
      kInterpolatorNames[bestInterpolator(subjects)]);
}

std::string rangeVerdict(const InterpolationResults& results) {
  const auto& [least, most] = results.range_mm[1];
  const auto& [from, to] = results.measured_mm;
  const bool within = least >= from - kRangeSlack && most <= to + kRangeSlack;
  return within ? fmt::format("GRI never leaves what was measured ({:.0f} to {:.0f} mm)", from, to)
                : fmt::format("GRI leaves what was measured ({:.0f} to {:.0f} mm)", from, to);
}

std::string accuracyFinding(const InterpolationResults& results) {
  const double apart = std::abs(results.subjects[1].rms_mm - results.subjects[0].rms_mm);
  return fmt::format(
      "{}: GRI and the plain mean are {:.0f} mm apart, subjects at one point {:.0f} mm. {}: over the back its half "
      "major "
      "axis is {:.0f} to {:.0f} mm, where the thin plate goes from {:.0f} to {:.0f} and the plane from {:.0f} to "
      "{:.0f}.",
      apart < results.scatter_mm ? "Five points on a back are too few to prefer one interpolation for its accuracy"
                                 : "The accuracy prefers one interpolation even with five points",
      apart, results.scatter_mm, rangeVerdict(results), results.range_mm[1].first, results.range_mm[1].second,
      results.range_mm[3].first, results.range_mm[3].second, results.range_mm[4].first, results.range_mm[4].second);
}

std::string quadraticFinding(const InterpolationResults& results) {
  const LeftOutErrors& quadratic = results.subjects[5];
  return fmt::format(
      "A polynomial of degree 2 has six terms; with a point and its mirror image left out it was not determined in {} "
      "of "
      "{} cases.",
      quadratic.undetermined, quadratic.undetermined + quadratic.predicted);
}

std::string widthFinding(const InterpolationResults& results) {
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;
  for (std::size_t i = 0; i < results.radii.size(); ++i) {
    if (results.radii[i] < kNarrowest) continue;
    least = std::min(least, results.subject_error_mm[i]);
    most = std::max(most, results.subject_error_mm[i]);
  }
  return fmt::format(
      "The width {} for foretelling: from {:.0f} to {:.0f} mm the error is {:.1f} to {:.1f} mm. The smallest of all, "
      "{:.1f} mm, is at {:.0f} mm, {:.0f} mm gives {:.1f} mm.",
      most <= (1.0 + kHardly) * least ? "hardly matters" : "matters", kNarrowest, results.radii.back(), least, most,
      *std::min_element(results.subject_error_mm.begin(), results.subject_error_mm.end()), bestRadius(results),
      kEffectRadius, results.subjects[1].rms_mm);
}

std::string upDownVerdict(double apart_mm, double by_chance_mm) {
  if (apart_mm > kBeyondChance * by_chance_mm) return "so it does not hold";
  return apart_mm > by_chance_mm ? "more than chance alone, but not by so much that eight people could refute it"
                                 : "no more than chance alone";
}

std::string upDownFinding(const InterpolationResults& results) {
  return fmt::format(
      "\"Down is similar to up\": over the back the boundaries of the two maps are {:.0f} mm apart (rms) and {:.0f} mm "
      "at "
      "most (E31). The scatter of five and three people would by itself make about {:.0f} mm: {}.",
      results.up_down_mm, results.up_down_most_mm, results.expected_up_down_mm,
      upDownVerdict(results.up_down_mm, results.expected_up_down_mm));
}

}  // namespace

double bestRadius(const InterpolationResults& results) {
  const auto best = std::min_element(results.subject_error_mm.begin(), results.subject_error_mm.end());
  return results.radii[static_cast<std::size_t>(best - results.subject_error_mm.begin())];
}

std::vector<std::string> interpolationFindings(const InterpolationResults& results) {
  return {diameterFinding(results),  predictedFinding(results), accuracyFinding(results),
          quadraticFinding(results), widthFinding(results),     upDownFinding(results)};
}

}  // namespace palpate::study
