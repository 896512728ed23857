#include "measure/study/measuring_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "palpate/base/order_statistics.h"
#include "report/page/study_page.h"

namespace palpate::study {

using measure::TailFamily;

namespace {

/// An accepted corrupted pair is right within what good ones are held to, or twice its stated sd.
constexpr double kRightPercent = 8.0;

/// One value of every pair that a test picks.
template <class Picks, class Value>
Percentiles percentiles(const std::vector<JudgedPair>& pairs, const Picks& picks, const Value& value) {
  std::vector<double> values;
  for (const JudgedPair& pair : pairs) {
    if (picks(pair)) values.push_back(value(pair));
  }
  return {quantileOf(values, 0.5), quantileOf(values, 0.95)};
}

void addOnce(std::vector<std::string>& codes, const std::string& code) {
  if (std::find(codes.begin(), codes.end(), code) == codes.end()) codes.push_back(code);
}

bool isRight(const JudgedPair& pair) {
  return pair.at_2_mm.worsePercent() <= kRightPercent || pair.at_2_mm.worseInSds() <= 2.0;
}

/// Not more than; a percentile of nothing is missed.
Bar atMost(std::string what, double bar, const std::string& unit, double reached) {
  return {std::move(what), fmt::format("<= {}{}", bar, unit), reached, rounded(reached, 3) + unit, reached <= bar};
}
Bar shareAtLeast(std::string what, double bar, double reached) {
  return {std::move(what), ">= " + percent(bar), reached, fmt::format("{:.1f} %", 100.0 * reached), reached >= bar};
}

}  // namespace

std::vector<std::string> halfAxisCells(const LevelErrors& errors) {
  std::vector<std::string> cells;
  for (const double percent :
       {errors.major.percent, errors.major.stated_percent, errors.minor.percent, errors.minor.stated_percent}) {
    cells.push_back(fmt::format("{:.3f}", percent));
  }
  return cells;
}

SetNumbers numbersOf(const std::vector<JudgedPair>& pairs) {
  SetNumbers set;
  set.pairs = pairs.size();
  std::size_t within = 0;
  for (const JudgedPair& pair : pairs) {
    if (!pair.accepted) continue;
    ++set.accepted;
    set.worst_axis_percent = std::max(set.worst_axis_percent, pair.at_2_mm.worsePercent());
    set.worst_axis_sds = std::max(set.worst_axis_sds, pair.at_2_mm.worseInSds());
    if (pair.at_2_mm.worseInSds() <= 2.0) ++within;
  }
  set.within_2_sd = set.accepted > 0 ? static_cast<double>(within) / static_cast<double>(set.accepted) : 0.0;
  const auto any = [](const JudgedPair& pair) { return pair.accepted; };
  const auto directed = [](const JudgedPair& pair) { return pair.accepted && pair.true_ratio >= kDirectedRatio; };
  const auto contoured = [](const JudgedPair& pair) { return pair.has_contour; };
  const auto contoured_and_directed = [](const JudgedPair& pair) {
    return pair.has_contour && pair.true_ratio >= kDirectedRatio;
  };
  set.axis2_percent = percentiles(pairs, any, [](const auto& pair) { return pair.at_2_mm.worsePercent(); });
  set.axis4_percent = percentiles(pairs, any, [](const auto& pair) { return pair.at_4_mm.worsePercent(); });
  set.ratio = percentiles(pairs, any, [](const auto& pair) { return pair.ratio_error; });
  set.direction_deg = percentiles(pairs, directed, [](const auto& pair) { return pair.direction_error_deg; });
  set.contact_mm = percentiles(pairs, any, [](const auto& pair) { return pair.contact_error_mm; });
  set.drag_deg = percentiles(pairs, any, [](const auto& pair) { return pair.drag_error_deg; });
  const auto peaked = [](const JudgedPair& pair) { return pair.accepted && pair.peak_stated; };
  set.peak_percent = percentiles(pairs, peaked, [](const auto& pair) { return std::abs(pair.peak.percent); });
  set.displacement_mm = percentiles(pairs, any, [](const auto& pair) { return pair.displacement_rms_mm; });
  set.chord_percent = percentiles(pairs, contoured, [](const auto& pair) { return std::abs(pair.chord_percent); });
  set.chord_direction_deg =
      percentiles(pairs, contoured_and_directed, [](const auto& pair) { return pair.chord_direction_deg; });
  return set;
}

std::vector<JudgedPair> ofFamily(const std::vector<JudgedPair>& pairs, TailFamily family) {
  std::vector<JudgedPair> chosen;
  for (const JudgedPair& pair : pairs) {
    if (pair.family == family) chosen.push_back(pair);
  }
  return chosen;
}

std::vector<CorruptedNumbers> corruptedNumbers(const MeasuringMeasurement& found) {
  std::vector<CorruptedNumbers> kinds;
  for (const CorruptedKind& kind : corruptedKinds()) kinds.push_back({.kind = kind});
  for (const JudgedCorrupted& corrupted : found.corrupted) {
    CorruptedNumbers& numbers = kinds[corrupted.kind];
    ++numbers.pairs;
    if (!corrupted.judged.accepted) {
      ++numbers.refused;
      for (const std::string& code : corrupted.judged.refusals) addOnce(numbers.codes, code);
      continue;
    }
    if (isRight(corrupted.judged)) ++numbers.right;
    numbers.worst_percent = std::max(numbers.worst_percent, corrupted.judged.at_2_mm.worsePercent());
  }
  return kinds;
}

DotNumbers dotNumbers(const std::vector<JudgedPair>& pairs) {
  DotNumbers numbers{.found_least = 1.0};
  std::size_t matched = 0;
  std::size_t wrong = 0;
  const auto count = static_cast<double>(std::max<std::size_t>(1, pairs.size()));
  for (const JudgedPair& pair : pairs) {
    numbers.found_mean += 0.5 * (pair.found_before + pair.found_after) / count;
    numbers.found_least = std::min({numbers.found_least, pair.found_before, pair.found_after});
    numbers.in_order_mean += pair.in_order / count;
    numbers.strays_in_order += static_cast<double>(pair.strays_in_order) / count;
    matched += pair.matched;
    wrong += pair.wrong_matches;
  }
  numbers.wrong_per_1000 = matched > 0 ? 1000.0 * static_cast<double>(wrong) / static_cast<double>(matched) : 0.0;
  return numbers;
}

double refusedAsMoved(const std::vector<JudgedPair>& pairs) {
  if (pairs.empty()) return 0.0;
  const auto moved = std::count_if(pairs.begin(), pairs.end(), [](const JudgedPair& pair) {
    return std::find(pair.refusals.begin(), pair.refusals.end(), "moved") != pair.refusals.end();
  });
  return static_cast<double>(moved) / static_cast<double>(pairs.size());
}

std::vector<Bar> checkBars(const MeasuringMeasurement& found) {
  const SetNumbers all = numbersOf(found.good);
  const SetNumbers compact = numbersOf(ofFamily(found.good, TailFamily::compact));
  const SetNumbers half_space = numbersOf(found.half_space.pairs);
  const SetNumbers lopsided = numbersOf(ofFamily(found.lopsided.pairs, TailFamily::compact));
  const DotNumbers dots = dotNumbers(found.good);
  std::size_t bad = 0;
  std::size_t refused = 0;
  for (const CorruptedNumbers& kind : corruptedNumbers(found)) {
    if (kind.kind.fate != Fate::refused) continue;
    bad += kind.pairs;
    refused += kind.refused;
  }
  return {
      shareAtLeast("good pairs accepted", 0.85, all.share()),
      atMost("half axes of 2 mm, compact tail (95 %)", 3.0, " %", compact.axis2_percent.p95),
      atMost("half axes of 2 mm, all (95 %)", 8.0, " %", all.axis2_percent.p95),
      shareAtLeast("half axes of 2 mm within 2 stated sd", 0.85, all.within_2_sd),
      atMost("half axes of 4 mm (95 %)", 5.0, " %", all.axis4_percent.p95),
      atMost("ratio (95 %)", 0.04, "", all.ratio.p95),
      atMost("direction, ratio from 1.15 (95 %)", 3.0, " degrees", all.direction_deg.p95),
      atMost("contact (95 %)", 2.0, " mm", all.contact_mm.p95),
      atMost("contact, 20 % stronger behind, compact (95 %)", 4.0, " mm", lopsided.contact_mm.p95),
      atMost("direction of the drag (95 %)", 3.0, " degrees", all.drag_deg.p95),
      atMost("displacement of dots, rms (95 %)", 0.25, " mm", all.displacement_mm.p95),
      atMost("peak, compact tail (95 %)", 8.0, " %", compact.peak_percent.p95),
      atMost("half axes of 2 mm, half space (95 %)", 14.0, " %", half_space.axis2_percent.p95),
      atMost("direction, half space (95 %)", 4.0, " degrees", half_space.direction_deg.p95),
      atMost("worst accepted half axis", 15.0, " %", all.worst_axis_percent),
      atMost("worst accepted half axis, in stated sd", 4.0, "", all.worst_axis_sds),
      shareAtLeast("bad pairs refused", 1.0, bad > 0 ? static_cast<double>(refused) / static_cast<double>(bad) : 0.0),
      shareAtLeast("drift of 1.5 mm refused as moved", 0.9, refusedAsMoved(found.drifted.pairs)),
      shareAtLeast("dots found, mean", 0.95, dots.found_mean),
      shareAtLeast("dots found, least of a picture", 0.88, dots.found_least),
      atMost("wrong matches of 1,000", 1.0, "", dots.wrong_per_1000),
      atMost("a pair of 12 megapixels, one core", 2.0, " s", found.large_s),
      atMost("100 fits of the field", 0.2, " s", found.hundred_fits_s)};
}

std::vector<std::pair<std::string, double>> measuringPairs(const MeasuringMeasurement& found) {
  const SetNumbers all = numbersOf(found.good);
  const SetNumbers compact = numbersOf(ofFamily(found.good, TailFamily::compact));
  const SetNumbers half_space = numbersOf(found.half_space.pairs);
  const SetNumbers windowed = numbersOf(found.windowed.pairs);
  const DotNumbers dots = dotNumbers(found.good);
  double bad = 0.0;
  double refused = 0.0;
  double worst = all.worst_axis_percent;
  for (const CorruptedNumbers& kind : corruptedNumbers(found)) {
    if (kind.kind.fate == Fate::refused) {
      bad += static_cast<double>(kind.pairs);
      refused += static_cast<double>(kind.refused);
    }
    if (kind.kind.fate == Fate::refused_or_right) worst = std::max(worst, kind.worst_percent);
  }
  return {{"accepted_share", all.share()},
          {"axis2_p95_percent", all.axis2_percent.p95},
          {"axis2_compact_p95_percent", compact.axis2_percent.p95},
          {"axis4_p95_percent", all.axis4_percent.p95},
          {"ratio_p95", all.ratio.p95},
          {"direction_p95_deg", all.direction_deg.p95},
          {"contact_p95_mm", all.contact_mm.p95},
          {"worst_axis_percent", worst},
          {"within_2_sd_share", all.within_2_sd},
          {"bad_pairs", bad},
          {"bad_pairs_rejected", refused},
          {"seconds_12_mp", found.large_s},
          {"cases", static_cast<double>(all.pairs)},
          {"drag_p95_deg", all.drag_deg.p95},
          {"displacement_rms_p95_mm", all.displacement_mm.p95},
          {"peak_compact_p95_percent", compact.peak_percent.p95},
          {"worst_axis_in_sd", all.worst_axis_sds},
          {"dots_found_mean", dots.found_mean},
          {"dots_found_least", dots.found_least},
          {"wrong_matches_per_1000", dots.wrong_per_1000},
          {"drift_1_5_rejected_share", refusedAsMoved(found.drifted.pairs)},
          {"half_space_axis2_p95_percent", half_space.axis2_percent.p95},
          {"half_space_direction_p95_deg", half_space.direction_deg.p95},
          {"windowed_axis2_p95_percent", windowed.axis2_percent.p95},
          {"fit_100_s", found.hundred_fits_s}};
}

}  // namespace palpate::study
