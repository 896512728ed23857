// The study of measuring: how far the numbers that photographs give are from the truth, on photographs whose truth is
// known.
#include "measure/study/measuring_study.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "measure/study/measuring_measurement.h"
#include "measure/study/measuring_numbers.h"
#include "measure/study/outside_study.h"
#include "palpate/base/order_statistics.h"
#include "palpate/measure/synthesis/synthetic_files.h"
#include "report/page/plot_parts.h"

namespace palpate::study {

namespace {

using measure::TailFamily;

constexpr std::array kFamilies = {TailFamily::compact, TailFamily::long_tail};
constexpr std::array kFamilyMarkers = {Marker::circle, Marker::cross};
constexpr std::array kFamilyColours = {figures::kBlue, figures::kVermilion};

std::string familyName(TailFamily family) { return fmt::format("{} tail", nameOf(family)); }

std::string both(const Percentiles& numbers) {
  return std::isnan(numbers.median) ? "-" : fmt::format("{} / {}", rounded(numbers.median), rounded(numbers.p95));
}

TextTable barTable(const MeasuringMeasurement& found) {
  TextTable table{{"", "bar", "reached", ""}, {}};
  for (const Bar& bar : checkBars(found))
    table.rows.push_back({bar.what, bar.bar, bar.shown, bar.met ? "met" : "missed"});
  return table;
}

std::vector<std::string> setRow(const std::string& name, const std::vector<JudgedPair>& pairs) {
  const SetNumbers set = numbersOf(pairs);
  return {name,
          fmt::format("{} of {}", set.accepted, set.pairs),
          both(set.axis2_percent),
          both(set.axis4_percent),
          both(set.ratio),
          both(set.direction_deg),
          both(set.contact_mm),
          both(set.drag_deg),
          both(set.peak_percent),
          both(set.displacement_mm),
          percent(set.within_2_sd)};
}

TextTable setTable(const MeasuringMeasurement& found) {
  TextTable table{
      {"median / 95 % of accepted pairs", "accepted", "half axes, 2 mm (%)", "half axes, 4 mm (%)", "ratio",
       "direction (degrees)", "contact (mm)", "drag (degrees)", "peak (%)", "dots, rms (mm)", "within 2 sd"},
      {}};
  for (const TailFamily family : kFamilies) {
    table.rows.push_back(setRow(familyName(family), ofFamily(found.good, family)));
  }
  table.rows.push_back(setRow("both", found.good));
  return table;
}

TextTable exactTable(const MeasuringMeasurement& found) {
  TextTable table = setTable(found);
  table.rows.clear();
  for (const ExactPairs* set :
       {&found.drifted, &found.breathing, &found.half_space, &found.windowed, &found.lopsided}) {
    table.rows.push_back(setRow(set->name, set->pairs));
  }
  return table;
}

TextTable corruptedTable(const MeasuringMeasurement& found) {
  TextTable table{{"pair", "must be", "refused", "accepted and right", "accepted and wrong", "refused as"}, {}};
  for (const CorruptedNumbers& kind : corruptedNumbers(found)) {
    const std::string fate = kind.kind.fate == Fate::refused            ? "refused"
                             : kind.kind.fate == Fate::refused_or_right ? "refused or right"
                                                                        : "(cannot be seen)";
    table.rows.push_back({kind.kind.name, fate, fmt::format("{} of {}", kind.refused, kind.pairs),
                          fmt::format("{}", kind.right), fmt::format("{}", kind.wrong()),
                          fmt::format("{}", fmt::join(kind.codes, ", "))});
  }
  return table;
}

TextTable ratioTable(const MeasuringMeasurement& found) {
  TextTable table{{"true ratio", "pairs", "error of the direction (degrees, median / 90 %)", "stated sd (median)"}, {}};
  for (const auto& [from, to] : {std::pair(1.0, 1.1), {1.1, 1.15}, {1.15, 1.3}, {1.3, 1.5}, {1.5, 1.81}}) {
    std::vector<double> errors;
    std::vector<double> stated;
    for (const JudgedPair& pair : found.good) {
      if (!pair.accepted || pair.true_ratio < from || pair.true_ratio >= to) continue;
      errors.push_back(pair.direction_error_deg);
      stated.push_back(pair.direction_sd_deg);
    }
    if (errors.empty()) continue;
    table.rows.push_back({fmt::format("{} to {}", from, std::min(to, 1.8)), fmt::format("{}", errors.size()),
                          fmt::format("{} / {}", rounded(quantileOf(errors, 0.5)), rounded(quantileOf(errors, 0.9))),
                          rounded(quantileOf(stated, 0.5))});
  }
  if (table.rows.empty()) table.rows.push_back({"none accepted", "0", "-", "-"});
  return table;
}

std::vector<std::string> caseRow(const std::string& name, const JudgedPair& pair) {
  const auto number = [](double value) { return fmt::format("{:.3f}", value); };
  std::vector<std::string> row = {name,
                                  fmt::format("{}", pair.seed),
                                  std::string(nameOf(pair.family)),
                                  pair.accepted ? "accepted" : "refused",
                                  fmt::format("{}", fmt::join(pair.refusals, " ")),
                                  number(pair.true_half_major_mm),
                                  number(pair.true_ratio)};
  for (const std::string& cell : halfAxisCells(pair.at_2_mm)) row.push_back(cell);
  for (const double value : {pair.at_4_mm.worsePercent(), pair.ratio_error, pair.direction_error_deg,
                             pair.contact_error_mm, pair.drag_error_deg, pair.residual_rms_mm}) {
    row.push_back(number(value));
  }
  row.push_back(fmt::format("{}", pair.wrong_matches));
  return row;
}

/// Every pair with its seed, for who wants to paint it again.
TextTable caseTable(const MeasuringMeasurement& found) {
  TextTable table{{"set", "seed", "tail", "verdict", "refused as", "true half major (mm)", "true ratio",
                   "major off (%)", "major sd (%)", "minor off (%)", "minor sd (%)", "4 mm off (%)", "ratio off",
                   "direction off (deg)", "contact off (mm)", "drag off (deg)", "residual (mm)", "wrong matches"},
                  {}};
  for (const JudgedPair& pair : found.good) table.rows.push_back(caseRow("good", pair));
  for (const JudgedCorrupted& pair : found.corrupted) {
    table.rows.push_back(caseRow(corruptedKinds()[pair.kind].name, pair.judged));
  }
  for (const ExactPairs* set :
       {&found.drifted, &found.breathing, &found.half_space, &found.windowed, &found.lopsided}) {
    for (const JudgedPair& pair : set->pairs) table.rows.push_back(caseRow(set->name, pair));
  }
  return table;
}

/// Points of the accepted good pairs of one family.
template <class X, class Y>
Series scatter(const MeasuringMeasurement& found, std::size_t family, const X& x, const Y& y) {
  Series series{.name = familyName(kFamilies[family]), .stroke = Stroke::none, .marker = kFamilyMarkers[family]};
  series.colour = kFamilyColours[family];
  for (const JudgedPair& pair : ofFamily(found.good, kFamilies[family])) {
    if (!pair.accepted) continue;
    series.x.push_back(x(pair));
    series.y.push_back(y(pair));
  }
  return series;
}

Plot sdPlot(const MeasuringMeasurement& found) {
  static constexpr double kMin = 0.1;
  constexpr double kMax = 30.0;
  Plot plot{.title = "Half axes of 2 mm: off and said"};
  plot.x = {.label = "stated sd", .unit = "%", .scale = Scale::logarithmic, .from = kMin, .to = kMax};
  plot.y = {.label = "error", .unit = "%", .scale = Scale::logarithmic, .from = kMin, .to = kMax};
  for (std::size_t family = 0; family < kFamilies.size(); ++family) {
    plot.series.push_back(scatter(
        found, family, [](const JudgedPair& pair) { return pair.at_2_mm.major.stated_percent; },
        [](const JudgedPair& pair) { return std::max(kMin, std::abs(pair.at_2_mm.major.percent)); }));
  }
  plot.series.push_back(
      {.name = "1 sd", .x = {kMin, kMax}, .y = {kMin, kMax}, .stroke = Stroke::dashed, .colour = figures::kInk});
  plot.series.push_back({.name = "2 sd",
                         .x = {kMin, 0.5 * kMax},
                         .y = {2.0 * kMin, kMax},
                         .stroke = Stroke::dotted,
                         .colour = figures::kInk});
  return plot;
}

Plot sharePlot(const MeasuringMeasurement& found) {
  Plot plot{.title = "Share of pairs with less error"};
  plot.x = {.label = "half axes of 2 mm, error of the worse", .unit = "%", .from = 0.0, .to = 15.0};
  plot.y = {.label = "share of accepted pairs", .from = 0.0, .to = 1.0};
  for (std::size_t family = 0; family < kFamilies.size(); ++family) {
    std::vector<double> errors;
    for (const JudgedPair& pair : ofFamily(found.good, kFamilies[family])) {
      if (pair.accepted) errors.push_back(pair.at_2_mm.worsePercent());
    }
    std::sort(errors.begin(), errors.end());
    Series series{.name = familyName(kFamilies[family]), .x = {0.0}, .y = {0.0}};
    series.colour = kFamilyColours[family];
    for (std::size_t i = 0; i < errors.size(); ++i) {
      series.x.push_back(std::min(15.0, errors[i]));
      series.y.push_back(static_cast<double>(i + 1) / static_cast<double>(errors.size()));
    }
    plot.series.push_back(std::move(series));
  }
  plot.shapes = {verticalLine("bar", 8.0, 0.0, 1.0)};
  return plot;
}

Plot directionPlot(const MeasuringMeasurement& found) {
  Plot plot{.title = "Direction of the major axis"};
  plot.x = {.label = "true ratio of the axes", .from = 1.0, .to = 1.8};
  plot.y = {.label = "error", .unit = "degrees", .scale = Scale::logarithmic, .from = 0.03, .to = 90.0};
  for (std::size_t family = 0; family < kFamilies.size(); ++family) {
    plot.series.push_back(scatter(
        found, family, [](const JudgedPair& pair) { return pair.true_ratio; },
        [](const JudgedPair& pair) { return std::max(0.03, pair.direction_error_deg); }));
  }
  return plot;
}

MeasuringPlan makeMeasuringPlan(const StudySettings& settings) {
  MeasuringPlan plan = measuringPlan(settings.quick);
  plan.seed = settings.seed.value_or(plan.seed);
  plan.cases = settings.cases.value_or(plan.cases);
  return plan;
}

std::string formatCommand(const StudySettings& settings, const MeasuringPlan& plan) {
  if (settings.quick && !settings.seed && !settings.cases) return {};
  return fmt::format("palpate study measuring --seed {} --cases {}{} --out DIR", plan.seed, plan.cases,
                     settings.quick ? " --quick" : "");
}

StudyPage studyMeasuring(const StudySettings& settings) {
  if (!settings.family.empty()) return studyMeasuringOutside(settings);
  const MeasuringPlan plan = makeMeasuringPlan(settings);
  const MeasuringMeasurement found = measureMeasuring(plan, settings.progress);
  return {
      .title = "Measuring the key ellipse from two photographs",
      .question =
          "The dissertation's deformation is measured: dots on a back, photographed before and after a "
          "stick drags the skin, a contour of 2 mm, an ellipse. How far may one trust what `palpate measure "
          "dots` makes of such photographs, and does it say so where one may not?",
      .findings = measuringFindings(found),
      .method = {"Photographs are painted (`palpate measure synthesize`): a back as a height field with a chart by "
                 "arc length, skin, dots set by a hand, a press whose motion is a half Gaussian or has a long tail, a "
                 "camera of any tilt to 25 degrees, a body that moves by 0.3 mm between the pictures (breath held), a "
                 "stick and a hand, noise, JPEG. Each pair is measured by the product's own code, which sees nothing "
                 "but the two pictures, and judged by the truth.",
                 fmt::format(
                     "{} good pairs, every second one with a long tail, of {} megapixels{}; {} corrupted pairs of "
                     "every kind; and {} pairs without pixels of every other kind, whose dots are projected "
                     "with 0.05 mm of noise and nothing painted. Seed {}; every pair's own seed stands in "
                     "measuring_cases.csv.",
                     plan.cases, plan.megapixels,
                     plan.large_every > 0 ? fmt::format(", one of {} of {}", plan.large_every, plan.timed_megapixels)
                                          : "",
                     plan.corrupted_each, plan.exact_each, plan.seed),
                 "An error of half axes is that of the worse of the two; percentiles are of accepted pairs. The true "
                 "ellipse of a field outside the formula is the one through its contour by least squares.",
                 "Nothing here is real: no photograph of a living back was at hand."},
      .tables = {{"measuring_bars", "What is asked for and what is reached.", barTable(found)},
                 {"measuring_tails", "Good pairs.", setTable(found)},
                 {"measuring_spoilt", "Pairs that something is wrong with.", corruptedTable(found)},
                 {"measuring_other", "Without pixels: bodies that moved, and fields outside the formula.",
                  exactTable(found)},
                 {"measuring_direction", "Direction by the ratio of the axes.", ratioTable(found)},
                 {"measuring_cases", "Every pair.", caseTable(found), false}},
      .figures =
          {{"measuring",
            "Error of the half major axis against the sd that is stated with it; share of pairs with less error; "
            "error of the direction by the ratio of the axes.",
            Figure{.panels = {sdPlot(found), sharePlot(found), directionPlot(found)}, .columns = 3}}},
      .numbers = measuringPairs(found),
      .numbers_on_top = true,
      .command = formatCommand(settings, plan)};
}

}  // namespace

Study measuringStudy() {
  return {.name = "measuring",
          .what = "Key ellipses from synthetic photographs against their truth: bars, refusals, honesty of the sd",
          .run = studyMeasuring,
          .draws = true,
          .families = namesOfOutsideFamilies(),
          .family_cases = kOutsideCases};
}

}  // namespace palpate::study
