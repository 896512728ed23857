// Fills in the sentences of measuring_findings.txt and the verdicts that the numbers decide.
#include "measure/study/measuring_measurement.h"

#include <algorithm>

#include "measure/study/measuring_numbers.h"
#include "measure_findings_texts.h"

namespace palpate::study {

namespace {

using measure::TailFamily;

FindingValues metBars(const MeasuringMeasurement& found) {
  const std::vector<Bar> bars = checkBars(found);
  FindingValues missed = FindingValues::array();
  for (const Bar& bar : bars) {
    if (!bar.met) missed.push_back({{"what", bar.what}, {"shown", bar.shown}, {"bar", bar.bar}});
  }
  return {
      {"missed", missed}, {"met", bars.size() - missed.size()}, {"bars", bars.size()}, {"pairs", found.good.size()}};
}

FindingValues axesOfFamilies(const MeasuringMeasurement& found) {
  const SetNumbers compact = numbersOf(ofFamily(found.good, TailFamily::compact));
  const SetNumbers tail = numbersOf(ofFamily(found.good, TailFamily::long_tail));
  const double times = tail.axis2_percent.p95 / compact.axis2_percent.p95;
  return {{"compact_2_median", compact.axis2_percent.median},
          {"compact_2", compact.axis2_percent.p95},
          {"tail_2_median", tail.axis2_percent.median},
          {"tail_2", tail.axis2_percent.p95},
          {"more", times > 2.0},
          {"times", times},
          {"compact_4_median", compact.axis4_percent.median},
          {"compact_4", compact.axis4_percent.p95},
          {"tail_4_median", tail.axis4_percent.median},
          {"tail_4", tail.axis4_percent.p95}};
}

FindingValues otherResults(const SetNumbers& all) {
  return {{"ratio", all.ratio.p95},
          {"directed_ratio", kDirectedRatio},
          {"direction_deg", all.direction_deg.p95},
          {"contact_mm", all.contact_mm.p95},
          {"drag_deg", all.drag_deg.p95}};
}

FindingValues statedSd(const SetNumbers& all) {
  return {{"honest", all.within_2_sd >= 0.85 && all.worst_axis_sds <= 4.0},
          {"within_2_sd", all.within_2_sd},
          {"worst_sds", all.worst_axis_sds},
          {"worst_percent", all.worst_axis_percent}};
}

FindingValues corruptedPairs(const MeasuringMeasurement& found) {
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
  return {{"bad", bad}, {"refused", refused}, {"through", through}, {"wrong", wrong}};
}

FindingValues movedBodies(const MeasuringMeasurement& found) {
  const double refused = refusedAsMoved(found.drifted.pairs);
  const SetNumbers told = numbersOf(found.breathing.pairs);
  return {{"noticed", refused >= 0.9},
          {"refused", refused},
          {"accepted", told.share()},
          {"axis_percent", told.axis2_percent.p95}};
}

FindingValues otherForms(const MeasuringMeasurement& found) {
  const SetNumbers half_space = numbersOf(found.half_space.pairs);
  const SetNumbers windowed = numbersOf(found.windowed.pairs);
  const SetNumbers lopsided = numbersOf(ofFamily(found.lopsided.pairs, TailFamily::compact));
  return {{"half_space_percent", half_space.axis2_percent.p95},
          {"half_space_deg", half_space.direction_deg.p95},
          {"windowed_percent", windowed.axis2_percent.p95},
          {"windowed_deg", windowed.direction_deg.p95},
          {"lopsided_mm", lopsided.contact_mm.p95},
          {"lopsided_percent", lopsided.axis2_percent.p95}};
}

FindingValues readOffContours(const SetNumbers& all) {
  return {{"median", all.chord_percent.median},
          {"percent", all.chord_percent.p95},
          {"direction_deg", all.chord_direction_deg.p95},
          {"fit_direction_deg", all.direction_deg.p95},
          {"fit", all.chord_direction_deg.p95 > 2.0 * all.direction_deg.p95}};
}

FindingValues foundDots(const MeasuringMeasurement& found) {
  const DotNumbers dots = dotNumbers(found.good);
  return {{"found_percent", 100.0 * dots.found_mean},
          {"least_percent", 100.0 * dots.found_least},
          {"in_order_percent", 100.0 * dots.in_order_mean},
          {"wrong", dots.wrong_per_1000}};
}

}  // namespace

std::vector<std::string> measuringFindings(const MeasuringMeasurement& found) {
  const SetNumbers all = numbersOf(found.good);
  return formatFindings(
      texts::measuring_findings,
      {{"bars", metBars(found)},
       {"axes", axesOfFamilies(found)},
       {"other", otherResults(all)},
       {"sd", statedSd(all)},
       {"corrupted", corruptedPairs(found)},
       {"drift", movedBodies(found)},
       {"form", otherForms(found)},
       {"contour", readOffContours(all)},
       {"dots", foundDots(found)},
       {"time",
        {{"megapixels", found.plan.timed_megapixels}, {"pair_s", found.large_s}, {"fits_s", found.hundred_fits_s}}}});
}

}  // namespace palpate::study
