#include "measure/study/outside_study.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "measure/study/measuring_numbers.h"

namespace palpate::study {

namespace {

double computeShare(std::size_t part, std::size_t all, double of_none) {
  return all > 0 ? static_cast<double>(part) / static_cast<double>(all) : of_none;
}

/// Warnings about how far the numbers may be trusted.
bool isWarned(const JudgedPair& pair) {
  return std::any_of(pair.warnings.begin(), pair.warnings.end(), [](const std::string& code) {
    return code == "form" || code == "forms" || code == "no_peak" || code == "imprecise";
  });
}

TextTable outsideTable(const std::vector<JudgedPair>& pairs) {
  TextTable table{{"seed",
                   "verdict",
                   "refused as",
                   "warnings",
                   "form",
                   "true half major (mm)",
                   "true ratio",
                   "major off (%)",
                   "major sd (%)",
                   "minor off (%)",
                   "minor sd (%)",
                   "4 mm major off (%)",
                   "4 mm major sd (%)",
                   "4 mm minor off (%)",
                   "4 mm minor sd (%)",
                   "peak off (%)",
                   "peak sd (%)",
                   "direction off (deg)",
                   "contact off (mm)",
                   "residual (mm)"},
                  {}};
  const auto number = [](double value) { return fmt::format("{:.3f}", value); };
  for (const JudgedPair& pair : pairs) {
    std::vector<std::string> row = {fmt::format("{}", pair.seed),
                                    pair.accepted ? "accepted" : "refused",
                                    fmt::format("{}", fmt::join(pair.refusals, " ")),
                                    fmt::format("{}", fmt::join(pair.warnings, " ")),
                                    pair.form,
                                    number(pair.true_half_major_mm),
                                    number(pair.true_ratio)};
    for (const LevelErrors& errors : {pair.at_2_mm, pair.at_4_mm}) {
      for (const std::string& cell : halfAxisCells(errors)) row.push_back(cell);
    }
    row.push_back(pair.peak_stated ? number(pair.peak.percent) : "-");
    row.push_back(pair.peak_stated ? number(pair.peak.stated_percent) : "-");
    for (const double value : {pair.direction_error_deg, pair.contact_error_mm, pair.residual_rms_mm}) {
      row.push_back(number(value));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

TextTable numbersTable(const OutsideNumbers& n, const SetNumbers& set) {
  const auto both = [](const Percentiles& p) { return fmt::format("{} / {}", rounded(p.median), rounded(p.p95)); };
  return {{"", ""},
          {{"pairs accepted", fmt::format("{} of {}", n.accepted, n.pairs)},
           {"both half axes of 2 mm within 2 sd", percent(n.axes_within_2sd)},
           {"both half axes of 4 mm within 2 sd", percent(n.axes4_within_2sd)},
           {"peaks stated", fmt::format("{} of {}", n.peaks, n.accepted)},
           {"of these within 2 sd", percent(n.peak_within_2sd)},
           {"accepted pairs with a warning about form or peak", percent(n.warned_share)},
           {"worse half axis of 2 mm off (%, median / 95 %)", both(set.axis2_percent)},
           {"worse half axis of 4 mm off (%, median / 95 %)", both(set.axis4_percent)},
           {"stated peak off (%, median / 95 %)", both(set.peak_percent)}}};
}

}  // namespace

OutsideNumbers outsideNumbers(const std::vector<JudgedPair>& pairs) {
  OutsideNumbers n;
  n.pairs = pairs.size();
  std::size_t axes = 0;
  std::size_t axes4 = 0;
  std::size_t peaks = 0;
  std::size_t warned = 0;
  std::size_t missed_warned = 0;
  for (const JudgedPair& pair : pairs) {
    if (!pair.accepted) continue;
    ++n.accepted;
    const bool within = pair.at_2_mm.worseInSds() <= 2.0;
    axes += static_cast<std::size_t>(within);
    axes4 += static_cast<std::size_t>(pair.at_4_mm.worseInSds() <= 2.0);
    n.peaks += static_cast<std::size_t>(pair.peak_stated);
    peaks += static_cast<std::size_t>(pair.peak_stated && pair.peak.inSds() <= 2.0);
    warned += static_cast<std::size_t>(isWarned(pair));
    missed_warned += static_cast<std::size_t>(!within && isWarned(pair));
  }
  n.axes_within_2sd = computeShare(axes, n.accepted, 0.0);
  n.axes4_within_2sd = computeShare(axes4, n.accepted, 0.0);
  n.peak_within_2sd = computeShare(peaks, n.peaks, 1.0);
  n.warned_share = computeShare(warned, n.accepted, 1.0);
  n.missed_warned_share = computeShare(missed_warned, n.accepted - axes, 1.0);
  return n;
}

std::vector<std::string> namesOfOutsideFamilies() {
  std::vector<std::string> names;
  for (const NamedFamily& family : outsideFamilies()) names.emplace_back(family.name);
  return names;
}

StudyPage studyMeasuringOutside(const StudySettings& settings) {
  const OutsideFamily family = parseOutsideFamily(settings.family);
  const std::size_t cases = settings.cases.value_or(settings.quick ? 4 : kOutsideCases);
  const std::uint64_t seed = settings.seed.value_or(1);
  const ExactPairs found = measureOutside(family, seed, cases, settings.progress);
  const OutsideNumbers n = outsideNumbers(found.pairs);
  const SetNumbers set = numbersOf(found.pairs);
  const std::string_view what = outsideFamilies()[static_cast<std::size_t>(family)].what;
  return {
      .name = "measuring_" + settings.family,
      .title = fmt::format("Measuring skin that moves as none of the fitted forms: {}", settings.family),
      .question = fmt::format("Skin moves as {}. Does the uncertainty that `palpate measure dots` states hold?", what),
      .findings = {fmt::format(
          "{} of {} pairs are accepted; in {} of these both half axes of 2 mm lie within two stated sd, in {} those "
          "of 4 mm. A peak is stated for {}, within two sd in {}. {} carry a warning about form or peak.",
          n.accepted, n.pairs, percent(n.axes_within_2sd), percent(n.axes4_within_2sd), n.peaks,
          percent(n.peak_within_2sd), percent(n.warned_share))},
      .method = {"Dots are projected with 0.05 mm of noise, nothing is painted; marks, camera and the body's motion "
                 "(0.3 mm) are drawn as for the other pairs. The true ellipse is the one through the contour by "
                 "least squares. Layers are solved by finite elements over the whole plane, six stacks by turns; "
                 "the fit has solved shapes of other stacks, along and across the drag only."},
      .tables = {{"measuring_" + settings.family, "What is stated and what holds.", numbersTable(n, set)},
                 {"measuring_" + settings.family + "_cases", "Every pair.", outsideTable(found.pairs), false}},
      .figures = {},
      .numbers = {{"axes_within_2sd", n.axes_within_2sd},
                  {"peak_within_2sd", n.peak_within_2sd},
                  {"accepted_share", n.acceptedShare()},
                  {"warned_share", n.warned_share},
                  {"axes4_within_2sd", n.axes4_within_2sd},
                  {"peak_stated_share", computeShare(n.peaks, n.accepted, 0.0)},
                  {"missed_warned_share", n.missed_warned_share},
                  {"axis2_median_percent", set.axis2_percent.median},
                  {"axis2_p95_percent", set.axis2_percent.p95},
                  {"axis4_p95_percent", set.axis4_percent.p95},
                  {"pairs", static_cast<double>(n.pairs)}},
      .numbers_on_top = true,
      .command = fmt::format("palpate study measuring --family {} --seed {} --cases {} --out DIR", settings.family,
                             seed, cases)};
}

}  // namespace palpate::study
