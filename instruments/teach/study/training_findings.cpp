#include "teach/study/training_measurement.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "report/page/study_page.h"
#include "teach/study/training_numbers.h"

namespace palpate::study {

namespace {

std::string thresholdBarsFinding(const TrainingMeasurement& found) {
  const std::vector<TrainingBar> bars = trainingBars(found);
  std::vector<std::string> missed;
  for (const TrainingBar& bar : bars) {
    if (!bar.met) missed.push_back(fmt::format("{}, {} ({})", bar.what, bar.reached, bar.bar));
  }
  if (missed.empty()) return fmt::format("All {} of what is asked for is reached.", bars.size());
  return fmt::format("Of {} that is asked for, {} is not reached: {}.", bars.size(), missed.size(),
                     fmt::join(missed, "; "));
}

std::string recoveryFinding(const TrainingMeasurement& found) {
  const CellExtremes of = findExtremes(findMethodRow(found, AskedBy::marginal_psi).cells);
  return fmt::format(
      "Forty trials among twelve places, levels by marginal psi, give back thresholds of 7, 14 and 28 % with a bias of "
      "at most {:.2f} percentage points and an SD of ln T of at most {:.3f}; the 95 % interval holds the truth in "
      "{:.1f} to {:.1f} % of {} runs each{}.",
      of.bias_points, of.sd_ln, 100.0 * of.coverage_least, 100.0 * of.coverage_most,
      counted(static_cast<double>(found.plan.runs)),
      of.coverage_least >= 0.95 ? ": it says rather too little than too much" : "");
}

std::optional<std::string> methodsFinding(const TrainingMeasurement& found) {
  if (!found.plan.all) return {};
  const MethodRow& best = findMethodRow(found, AskedBy::marginal_psi);
  const MethodRow& walk = findMethodRow(found, AskedBy::two_down);
  const MethodRow& constant = findMethodRow(found, AskedBy::constant);
  const auto trials = [](const MethodRow& row) {
    return row.most_to_15 > 0 ? fmt::format("{} to {}", row.least_to_15, row.most_to_15) : std::string("more than 80");
  };
  const double ratio = findExtremes(walk.cells).sd_ln / findExtremes(best.cells).sd_ln;
  return fmt::format(
      "The fit matters more than the rule: 2-down-1-up with the same fit has an SD {:.2f} times that of marginal "
      "psi{}. Until the error of ln T stays below 15 % it takes {} trials by marginal psi, {} by 2-down-1-up and {} at "
      "constant levels.",
      ratio, ratio < 1.2 ? ", which few would notice" : "", trials(best), trials(walk), trials(constant));
}

std::string readingFinding(const TrainingMeasurement& found) {
  const ReadingRow& turns = found.readings.front();
  const ReadingRow& first = found.readings.at(1);
  const ReadingRow& up_down = found.readings.at(2);
  return fmt::format(
      "Without a fit the same trials say something else: the mean of six reversals reads {:.2f} to {:.2f} T, and the "
      "interval from their own spread holds what it aims at in {:.0f} % of runs; mastery of 3 of 4 until the first "
      "failure reads {:.2f} to {:.2f} T, up and down {:.2f} to {:.2f} T. A level is no threshold.",
      turns.least_ratio, turns.most_ratio, 100.0 * turns.coverage, first.least_ratio, first.most_ratio,
      up_down.least_ratio, up_down.most_ratio);
}

std::optional<std::string> outsideFinding(const TrainingMeasurement& found) {
  if (found.robust.size() < 4) return {};
  std::vector<std::string> rows;
  for (std::size_t i = 0; i < 4; ++i) {
    const CellExtremes of = findExtremes(found.robust[i].cells);
    rows.push_back(
        fmt::format("{}: {:.1f} points, {:.1f} %", found.robust[i].name, of.bias_points, 100.0 * of.coverage_least));
  }
  return fmt::format(
      "Trainees whom the prior does not foresee are measured a little worse (largest bias, least "
      "coverage): {}.",
      fmt::join(rows, "; "));
}

std::optional<std::string> stopFinding(const TrainingMeasurement& found) {
  std::vector<std::string> rules;
  double least = 1.0;
  for (const NamedCells& rule : found.stop_rules) {
    const CellExtremes of = findExtremes(rule.cells);
    least = std::min(least, of.coverage_least);
    rules.push_back(fmt::format("{}: {:.0f} trials on average, SD {:.2f}, coverage {:.3f} at least", rule.name,
                                of.mean_trials, of.sd_ln, of.coverage_least));
  }
  if (rules.empty()) return {};
  return fmt::format("Stopping when half the interval of ln T is narrow enough (20 to 60 trials) {}: {}.",
                     least >= 0.94 ? "costs no honesty" : "makes intervals that are too narrow",
                     fmt::join(rules, "; "));
}

std::string leftOutFinding(const TrainingMeasurement& found) {
  std::vector<std::string> rows;
  double worst_corrected = 0.0;
  double worst_naive = 0.0;
  for (const ExplorationRow& row : found.exploration) {
    if (row.searched == 12) continue;
    rows.push_back(fmt::format("{} of 12: {:.0f} % as it is, {:.1f} % corrected, {:.0f} of 40 trials usable",
                               row.searched, 100.0 * row.naive.truth + row.naive.bias_points,
                               100.0 * row.corrected.truth + row.corrected.bias_points, row.usable));
    worst_corrected = std::max(worst_corrected, correctedPercent(row));
    worst_naive = std::max(worst_naive, naivePercent(row));
  }
  return fmt::format(
      "Places that are never pressed are the largest error of all. A true 28 % reads ({}): {}.", fmt::join(rows, "; "),
      worst_corrected < 10.0 && worst_naive > 40.0
          ? "leaving out trials whose target was not felt, and converting the rest, is worth more than any method"
          : "the correction does not repair it");
}

std::string examinationFinding(const TrainingMeasurement& found) {
  const ExamRow& able = found.exam.front();
  const ExamRow& other = found.exam.back();
  std::string text = fmt::format(
      "Examined at a mark of 20 %, 40 trials pass {:.1f} % of those at 14 % and {:.1f} % of those at 28 %. One that "
      "stops when it is sure takes {:.0f} and {:.0f} trials on average, gives the wrong verdict to {:.1f} and {:.1f} "
      "%, and asks {:.0f} and {:.0f} % to repeat.",
      100.0 * able.fixed_pass, 100.0 * other.fixed_pass, able.mean_trials, other.mean_trials, 100.0 * able.not_yet,
      100.0 * other.pass, 100.0 * able.repeat, 100.0 * other.repeat);
  double most_repeat = 0.0;
  for (const ExamRow& row : found.exam) most_repeat = std::max(most_repeat, row.repeat);
  if (found.exam.size() > 2) {
    text += fmt::format(
        " Near the mark up to {:.0f} % stay undecided: no number of trials that anybody sits through "
        "tells them apart.",
        100.0 * most_repeat);
  }
  return text;
}

std::optional<std::string> twoFinding(const TrainingMeasurement& found) {
  if (found.two_intervals.cells.empty()) return {};
  const CellExtremes of = findExtremes(found.two_intervals.cells);
  return fmt::format(
      "Two intervals take five times the trials: after 200 the bias is {:.1f} points and the SD of ln T "
      "{:.2f}. Twelve places are what to measure with.",
      of.bias_points, of.sd_ln);
}

std::optional<std::string> learnersFinding(const TrainingMeasurement& found) {
  if (found.learning.empty()) return {};
  const LearningRow& row = found.learning.back();
  const ChangeRow& change = found.changes.back();
  return fmt::format(
      "Over six sessions of {} trials the filtered curve is off by {:.3f} (rms of ln T, sessions 2 to 6) where "
      "separate sessions are off by {:.3f}; bands of the fitted exponential hold {:.0f} % of the true values. One "
      "person's change between two tests of {} is called real beyond a factor of {:.2f}: that happens to {:.1f} % of "
      "unchanged people, and sees {:.0f} % of those who halve their threshold.",
      row.trials, row.filtered_error, row.separate_error, 100.0 * found.band_coverage, change.trials, change.factor,
      100.0 * change.false_alarm, 100.0 * change.seen);
}

std::string exampleFinding(const TrainingMeasurement& found) {
  const WorkedExample& example = found.example;
  std::string text = fmt::format(
      "89 simulated trainees who go from 28 to 14 %, as published, are reported as {:.1f} % (SD {:.1f}) and {:.1f} % "
      "(SD {:.1f}); fitted together, {:.1f} % ({:.1f} to {:.1f}) and {:.1f} % ({:.1f} to {:.1f}), smaller by a factor "
      "of {:.2f} ({:.2f} to {:.2f}).",
      100.0 * example.mean_before, 100.0 * example.sd_before, 100.0 * example.mean_after, 100.0 * example.sd_after,
      100.0 * example.group_before.mean, 100.0 * example.group_before.low, 100.0 * example.group_before.high,
      100.0 * example.group_after.mean, 100.0 * example.group_after.low, 100.0 * example.group_after.high,
      example.change.factor, example.change.low, example.change.high);
  if (found.plan.groups > 0) {
    text += fmt::format(
        " Intervals of the group's mean hold it in {:.0f} % of {} groups when fitted together, in {:.0f} % "
        "when made of people's medians.",
        100.0 * example.covered_by_groups, 2 * found.plan.groups, 100.0 * example.covered_by_medians);
  }
  if (!found.power.empty()) {
    std::vector<std::string> sizes;
    for (const PowerRow& row : found.power) sizes.push_back(fmt::format("{} people: {:.3f}", row.people, row.power));
    text += fmt::format(" Power to see it in a paired test: {}.", fmt::join(sizes, ", "));
  }
  return text;
}

std::string timesFinding(const TrainingMeasurement& found) {
  return fmt::format("The next level is found in {:.0f} us (median; 99 %: {:.0f} us) on one core.",
                     found.next_level_us_p50, found.next_level_us_p99);
}

std::string simulationCaveat() {
  return "All of this is simulated: trainees who are a psychometric function, do not tire and do not learn within a "
         "test. What a finger, a device and a motor habit add is not in it, and nothing here says that a small "
         "threshold is skill on patients.";
}

}  // namespace

std::vector<std::string> trainingFindings(const TrainingMeasurement& found) {
  std::vector<std::string> findings = {thresholdBarsFinding(found), recoveryFinding(found)};
  const auto add = [&](const std::optional<std::string>& finding) {
    if (finding) findings.push_back(*finding);
  };
  add(methodsFinding(found));
  add(readingFinding(found));
  add(outsideFinding(found));
  add(stopFinding(found));
  add(leftOutFinding(found));
  add(examinationFinding(found));
  add(twoFinding(found));
  add(learnersFinding(found));
  add(exampleFinding(found));
  add(timesFinding(found));
  add(simulationCaveat());
  return findings;
}

}  // namespace palpate::study
