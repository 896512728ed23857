#include "measure/study/measuring_measurement.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "measure/study/measuring_numbers.h"
#include "report/page/study_page.h"

namespace palpate::study {

namespace {

using measure::TailFamily;

std::string barsFinding(const MeasuringMeasurement& found) {
  const std::vector<Bar> bars = barsOf(found);
  std::vector<std::string> missed;
  for (const Bar& bar : bars) {
    if (!bar.met) missed.push_back(fmt::format("{} ({}, asked for {})", bar.what, bar.shown, bar.bar));
  }
  if (missed.empty()) return fmt::format("All {} bars are met by {} drawn pairs.", bars.size(), found.good.size());
  return fmt::format("{} of {} bars are met by {} drawn pairs; NOT: {}.", bars.size() - missed.size(), bars.size(),
                     found.good.size(), fmt::join(missed, "; "));
}

std::string axisFinding(const MeasuringMeasurement& found) {
  const SetNumbers compact = numbersOf(ofFamily(found.good, TailFamily::compact));
  const SetNumbers tail = numbersOf(ofFamily(found.good, TailFamily::long_tail));
  const double times = tail.axis2_percent.p95 / compact.axis2_percent.p95;
  return fmt::format(
      "Of accepted pairs the half axes of the 2 mm ellipse are off by {} % (median; 95 %: {} %) where the motion falls "
      "off as a half Gaussian, and by {} % ({} %) where it has a long tail, {}; at 4 mm by {} % ({} %) and {} % ({} "
      "%).",
      rounded(compact.axis2_percent.median), rounded(compact.axis2_percent.p95), rounded(tail.axis2_percent.median),
      rounded(tail.axis2_percent.p95),
      times > 2.0 ? fmt::format("{} times as much: there a small motion of the body is a large part of the ellipse",
                                rounded(times))
                  : "about as much",
      rounded(compact.axis4_percent.median), rounded(compact.axis4_percent.p95), rounded(tail.axis4_percent.median),
      rounded(tail.axis4_percent.p95));
}

std::string otherFinding(const MeasuringMeasurement& found) {
  const SetNumbers all = numbersOf(found.good);
  return fmt::format(
      "The ratio of the axes is off by {} (95 %), the direction of ellipses with a ratio from {} by {} degrees, the "
      "contact by {} mm, the direction of the drag by {} degrees.",
      rounded(all.ratio.p95), kDirectedRatio, rounded(all.direction_deg.p95), rounded(all.contact_mm.p95),
      rounded(all.drag_deg.p95));
}

std::string sdFinding(const MeasuringMeasurement& found) {
  const SetNumbers all = numbersOf(found.good);
  return fmt::format(
      "The stated sd of half axes {}: {} of the accepted pairs are within twice of it, the worst is {} of it and {} % "
      "off.",
      all.within_2_sd >= 0.85 && all.worst_axis_sds <= 4.0 ? "is honest" : "is TOO SMALL", percent(all.within_2_sd),
      rounded(all.worst_axis_sds), rounded(all.worst_axis_percent));
}

std::string corruptedFinding(const MeasuringMeasurement& found) {
  std::size_t bad = 0;
  std::size_t refused = 0;
  std::vector<std::string> through;
  std::vector<std::string> wrong;
  for (const CorruptedNumbers& kind : corruptedNumbers(found)) {
    if (kind.kind.fate == Fate::refused) {
      bad += kind.pairs;
      refused += kind.refused;
      if (kind.refused < kind.pairs) through.push_back(kind.kind.name);
    } else if (kind.kind.fate == Fate::refused_or_right && kind.wrong() > 0) {
      wrong.push_back(kind.kind.name);
    }
  }
  std::string text = fmt::format("Of {} pairs that something is wrong with {} are refused{}.", bad, refused,
                                 through.empty() ? "" : fmt::format("; LET THROUGH: {}", fmt::join(through, ", ")));
  text += wrong.empty()
              ? " Of pairs that are only hard none is accepted and wrong."
              : fmt::format(" Of pairs that are only hard some are ACCEPTED AND WRONG: {}.", fmt::join(wrong, ", "));
  return text;
}

std::string driftFinding(const MeasuringMeasurement& found) {
  const double refused = refusedAsMoved(found.drifted.pairs);
  const SetNumbers told = numbersOf(found.breathing.pairs);
  return fmt::format(
      "A body that moves by 1.5 mm between the pictures is {} ({} refused as moved). Told so by --drift-mm 1.5, {} are "
      "accepted, with half axes off by {} % (95 %).",
      refused >= 0.9 ? "noticed" : "often NOT noticed", percent(refused), percent(told.share()),
      rounded(told.axis2_percent.p95));
}

std::string formFinding(const MeasuringMeasurement& found) {
  const SetNumbers half_space = numbersOf(found.half_space.pairs);
  const SetNumbers windowed = numbersOf(found.windowed.pairs);
  const SetNumbers lopsided = numbersOf(ofFamily(found.lopsided.pairs, TailFamily::compact));
  return fmt::format(
      "Fields outside the fitted formula: of an elastic half space the half axes are off by {} % (95 %) and the "
      "direction by {} degrees, of one that ends by {} % and {} degrees; where the skin moves 20 % more behind the "
      "stick, the contact of compact fields is off by {} mm and the half axes by {} %.",
      rounded(half_space.axis2_percent.p95), rounded(half_space.direction_deg.p95), rounded(windowed.axis2_percent.p95),
      rounded(windowed.direction_deg.p95), rounded(lopsided.contact_mm.p95), rounded(lopsided.axis2_percent.p95));
}

std::string contourFinding(const MeasuringMeasurement& found) {
  const SetNumbers all = numbersOf(found.good);
  return fmt::format(
      "Read as in the dissertation, by the longest chord of the interpolated 2 mm contour after the fitted drift is "
      "taken off, the same pairs give half axes off by {} % (median; 95 %: {} %) and directions off by {} degrees "
      "(95 %), against {} degrees of the fit: {}.",
      rounded(all.chord_percent.median), rounded(all.chord_percent.p95), rounded(all.chord_direction_deg.p95),
      rounded(all.direction_deg.p95),
      all.chord_direction_deg.p95 > 2.0 * all.direction_deg.p95 ? "the fit is what to go by"
                                                                : "there is little between them");
}

std::string dotsFinding(const MeasuringMeasurement& found) {
  const DotNumbers dots = dotNumbers(found.good);
  return fmt::format(
      "{:.1f} % of the dots are found (of the worst picture {:.1f} %), {:.1f} % are put in order, and {} of 1,000 "
      "matches are wrong.",
      100.0 * dots.found_mean, 100.0 * dots.found_least, 100.0 * dots.in_order_mean, rounded(dots.wrong_per_1000));
}

std::string timeFinding(const MeasuringMeasurement& found) {
  return fmt::format("A pair of {} megapixels takes {} s on one core from its files to findings; a hundred fits {} s.",
                     found.plan.timed_megapixels, rounded(found.large_s), rounded(found.hundred_fits_s));
}

std::string syntheticFinding() {
  return "All of this is synthetic: no photograph of a living back was measured yet. The pictures are painted by the "
         "same house that measures them; what real skin, ink, light and breathing do besides is not in them.";
}

}  // namespace

std::vector<std::string> measuringFindings(const MeasuringMeasurement& found) {
  return {barsFinding(found),      axisFinding(found),  otherFinding(found), sdFinding(found),
          corruptedFinding(found), driftFinding(found), formFinding(found),  contourFinding(found),
          dotsFinding(found),      timeFinding(found),  syntheticFinding()};
}

}  // namespace palpate::study
