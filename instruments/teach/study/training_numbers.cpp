#include "teach/study/training_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "palpate/base/error.h"

namespace palpate::study {

namespace {

/// The published course: 28 % before, 14 % after; percentage points.
constexpr double kBeforePoints = 28.0;
constexpr double kAfterPoints = 14.0;

TrainingBar notOver(std::string what, double bar, double reached, const std::string& unit = "") {
  return {std::move(what), fmt::format("<= {}{}", bar, unit), fmt::format("{:.3g}{}", reached, unit), reached <= bar};
}

TrainingBar noLess(std::string what, double bar, double reached) {
  return {std::move(what), fmt::format(">= {}", bar), fmt::format("{:.3g}", reached), reached >= bar};
}

void addRecovery(std::vector<TrainingBar>& bars, const TrainingMeasurement& found, AskedBy method) {
  const MethodRow& row = findMethodRow(found, method);
  const CellExtremes of = findExtremes(row.cells);
  const std::string name = nameOf(method);
  bars.push_back(notOver(name + ", 40 trials, T of 7, 14, 28 %: bias", 1.0, of.bias_points, " points"));
  bars.push_back(notOver(name + ": SD of ln T", 0.16, of.sd_ln));
  bars.push_back({name + ": coverage", "0.93 to 0.99",
                  fmt::format("{:.3f} to {:.3f}", of.coverage_least, of.coverage_most),
                  of.coverage_least >= 0.93 && of.coverage_most <= 0.99});
  if (row.cells.size() > 3) {
    bars.push_back(notOver(name + ", T of 40 %: bias", 1.5, std::abs(row.cells[3].bias_points), " points"));
  }
}

void addOutside(std::vector<TrainingBar>& bars, const TrainingMeasurement& found) {
  if (found.robust.size() < 4) return;
  for (std::size_t i = 0; i < 4; ++i) {
    const CellExtremes of = findExtremes(found.robust[i].cells);
    const bool lapses = i < 2;
    bars.push_back(notOver(found.robust[i].name + ": bias", lapses ? 1.8 : 2.2, of.bias_points, " points"));
    bars.push_back(noLess(found.robust[i].name + ": coverage", lapses ? 0.93 : 0.86, of.coverage_least));
  }
  for (const NamedCells& rule : found.stop_rules) {
    if (rule.name != "0.35") continue;
    const CellExtremes of = findExtremes(rule.cells);
    bars.push_back(notOver("stop rule of half width 0.35: mean trials", 40.0, of.mean_trials));
    bars.push_back(noLess("stop rule of half width 0.35: coverage", 0.94, of.coverage_least));
  }
}

void addTwoIntervals(std::vector<TrainingBar>& bars, const TrainingMeasurement& found) {
  if (found.two_intervals.cells.empty()) return;
  const CellExtremes of = findExtremes(found.two_intervals.cells);
  bars.push_back(notOver("two intervals, 200 trials: bias", 1.5, of.bias_points, " points"));
  bars.push_back(notOver("two intervals, 200 trials: SD of ln T", 0.17, of.sd_ln));
}

void addExploration(std::vector<TrainingBar>& bars, const TrainingMeasurement& found) {
  for (const ExplorationRow& row : found.exploration) {
    if (row.searched != 8) continue;
    bars.push_back(notOver("8 of 12 places searched, corrected: error of T", 10.0, correctedPercent(row), " %"));
    bars.push_back(noLess("the same taken as it is (%), so that the correction is needed", 40.0, naivePercent(row)));
  }
}

void addExam(std::vector<TrainingBar>& bars, const TrainingMeasurement& found) {
  const ExamRow& able = found.exam.front();
  const ExamRow& not_yet = found.exam.back();
  bars.push_back(noLess("examination of 40 trials, T of 14 %: pass", 0.98, able.fixed_pass));
  bars.push_back(notOver("examination of 40 trials, T of 28 %: pass", 0.04, not_yet.fixed_pass));
  bars.push_back(notOver("sequential examination: wrong verdicts", 0.02, std::max(able.not_yet, not_yet.pass)));
  bars.push_back(
      notOver("sequential examination, T of 14 and 28 %: repeat", 0.10, std::max(able.repeat, not_yet.repeat)));
  bars.push_back(notOver("sequential examination: mean trials", 28.0, std::max(able.mean_trials, not_yet.mean_trials)));
}

void addExample(std::vector<TrainingBar>& bars, const TrainingMeasurement& found) {
  const WorkedExample& example = found.example;
  bars.push_back(notOver("89 trainees, 28 %: mean is off by", 2.5,
                         std::abs(100.0 * example.mean_before - kBeforePoints), " points"));
  bars.push_back(notOver("89 trainees, 14 %: mean is off by", 1.2, std::abs(100.0 * example.mean_after - kAfterPoints),
                         " points"));
  bars.push_back(notOver("89 trainees, before: SD of reported T", 11.0, 100.0 * example.sd_before, " points"));
  bars.push_back(notOver("89 trainees, after: SD of reported T", 5.5, 100.0 * example.sd_after, " points"));
  for (const PowerRow& row : found.power) {
    if (row.people == 10) bars.push_back(noLess("ten trainees, 28 to 14 %: power", 0.95, row.power));
  }
}

}  // namespace

CellExtremes findExtremes(const std::vector<RecoveryCell>& cells, double most_truth) {
  CellExtremes of;
  for (const RecoveryCell& cell : cells) {
    if (cell.truth > most_truth) continue;
    of.bias_points = std::max(of.bias_points, std::abs(cell.bias_points));
    of.sd_ln = std::max(of.sd_ln, cell.sd_ln);
    of.coverage_least = std::min(of.coverage_least, cell.coverage);
    of.coverage_most = std::max(of.coverage_most, cell.coverage);
    of.mean_trials = std::max(of.mean_trials, cell.mean_trials);
  }
  return of;
}

const MethodRow& findMethodRow(const TrainingMeasurement& found, AskedBy method) {
  for (const MethodRow& row : found.methods) {
    if (row.method == method) return row;
  }
  throw Error("not measured: " + nameOf(method));
}

double correctedPercent(const ExplorationRow& row) { return std::abs(row.corrected.bias_points) / row.corrected.truth; }

double naivePercent(const ExplorationRow& row) { return row.naive.bias_points / row.naive.truth; }

std::vector<TrainingBar> trainingBars(const TrainingMeasurement& found) {
  std::vector<TrainingBar> bars;
  addRecovery(bars, found, AskedBy::marginal_psi);
  if (found.plan.all) addRecovery(bars, found, AskedBy::two_down);
  addOutside(bars, found);
  addTwoIntervals(bars, found);
  addExploration(bars, found);
  addExam(bars, found);
  addExample(bars, found);
  bars.push_back(notOver("next level, 99 %, processor time", 1000.0, found.next_level_us_p99, " us"));
  return bars;
}

std::vector<std::pair<std::string, double>> trainingPairs(const TrainingMeasurement& found) {
  const CellExtremes of = findExtremes(findMethodRow(found, AskedBy::marginal_psi).cells);
  double exploration_error = 0.0;
  for (const ExplorationRow& row : found.exploration) {
    if (row.searched == 8) exploration_error = correctedPercent(row);
  }
  std::vector<std::pair<std::string, double>> pairs = {
      {"bias_points_max", of.bias_points},
      {"sd_ln_t_max", of.sd_ln},
      {"coverage_min", of.coverage_least},
      {"coverage_max", of.coverage_most},
      {"next_level_us_p99", found.next_level_us_p99},
      {"next_level_us_p50", found.next_level_us_p50},
      {"exploration_error_percent", exploration_error},
      {"exam_pass_14", found.exam.front().fixed_pass},
      {"exam_pass_28", found.exam.back().fixed_pass},
      {"exam_sequential_repeat_max", std::max(found.exam.front().repeat, found.exam.back().repeat)},
      {"exam_sequential_wrong_max", std::max(found.exam.front().not_yet, found.exam.back().pass)},
      {"exam_sequential_trials_max", std::max(found.exam.front().mean_trials, found.exam.back().mean_trials)},
      {"effect_pre", 100.0 * found.example.mean_before},
      {"effect_post", 100.0 * found.example.mean_after},
      {"effect_pre_sd", 100.0 * found.example.sd_before},
      {"effect_post_sd", 100.0 * found.example.sd_after}};
  for (const PowerRow& row : found.power) pairs.emplace_back(fmt::format("power_{}", row.people), row.power);
  return pairs;
}

}  // namespace palpate::study
