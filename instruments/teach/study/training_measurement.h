// Tests, examinations and lessons of simulated trainees whose thresholds are known: the recovered thresholds, their
// certainty, and the trials needed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/training/group_estimate.h"
#include "palpate/training/learning_curve.h"
#include "report/page/study_page.h"
#include "teach/study/asked_test.h"

namespace palpate::study {

struct TrainingPlan {
  std::uint64_t seed = 1;
  std::size_t runs = 1000;         ///< a cell of the main table, of exploration and examination
  std::size_t beside_runs = 1000;  ///< for methods other than the product's first
  std::size_t robust_runs = 400;   ///< for cases outside the model
  std::size_t two_runs = 400;      ///< for two intervals
  std::size_t repeats = 400;       ///< for a comparison of ten trainees
  std::size_t people = 300;        ///< trainees who learn over six sessions
  std::size_t groups = 60;         ///< groups of 89, for how often an interval of their mean is right
  int longest = 80;                ///< trials that convergence is followed for
  bool all = true;                 ///< else only what the main numbers need
};

/// `runs`: of every cell, where given.
TrainingPlan trainingPlan(bool quick, std::optional<std::size_t> runs = {});

/// Reported thresholds against the true one.
struct RecoveryCell {
  double truth = 0.0;
  double bias_points = 0.0;  ///< mean of the reported value, less the truth; percentage points
  double sd_ln = 0.0;        ///< SD of ln T over runs
  double coverage = 0.0;     ///< share of 95 % intervals that hold the truth
  double mean_trials = 0.0;
  double trials_90 = 0.0;  ///< nine in ten take no more
};

struct MethodRow {
  AskedBy method = AskedBy::marginal_psi;
  std::vector<RecoveryCell> cells{};  ///< one per truth, after 40 trials
  std::vector<double> error_ln{};     ///< rms error of ln T after each trial, over runs and truths
  int least_to_15 = 0;                ///< trials until that error stays below 0.15, for the best and the worst truth;
  int most_to_15 = 0;                 ///< 0: not within the longest
};

/// Readings without a posterior, at 40 trials, as a ratio to the truth.
struct ReadingRow {
  std::string name;
  double least_ratio = 0.0;  ///< mean over runs, of the truths
  double most_ratio = 0.0;
  double sd_ln = 0.0;     ///< the largest
  double coverage = 0.0;  ///< how often the interval of the reversals' own spread covers the rule's aim; 0: none
  double told = 1.0;      ///< share of runs that give a reading at all
};

struct NamedCells {
  std::string name;
  std::vector<RecoveryCell> cells{};
};

struct ExplorationRow {
  int searched = 12;       ///< sites searched, of twelve
  RecoveryCell corrected;  ///< trials of targets not felt left out, guesses and threshold converted
  RecoveryCell naive;      ///< every trial taken as one among twelve
  double usable = 0.0;     ///< trials of 40
};

struct ExamRow {
  double truth = 0.0;
  double fixed_pass = 0.0;  ///< shares; 40 trials
  double pass = 0.0;        ///< sequential
  double not_yet = 0.0;
  double repeat = 0.0;
  double mean_trials = 0.0;
};

struct PowerRow {
  int people = 0;
  double power = 0.0;  ///< share of repeats in which 28 -> 14 % is seen
};

struct LearningRow {
  int trials = 0;               ///< a session
  double separate_error = 0.0;  ///< rms of ln T, sessions 2 to 6
  double filtered_error = 0.0;
  double filtered_bias = 0.0;
};

/// One person twice.
struct ChangeRow {
  int trials = 0;
  double factor = 1.0;       ///< requested
  double false_alarm = 0.0;  ///< share of unchanged people who are called changed
  double seen = 0.0;         ///< share of those who went from 28 to 14 %
};

/// Six sessions of one trainee, for the picture.
struct LearningExample {
  std::vector<double> truth;
  std::vector<training::LearningPoint> points;
  std::optional<training::LearningFit> fit;
};

/// 89 trainees, before and after, as they would be reported.
struct WorkedExample {
  std::vector<double> before;  ///< reported T, sorted
  std::vector<double> after;
  double mean_before = 0.0, sd_before = 0.0, mean_after = 0.0, sd_after = 0.0;
  training::GroupEstimate group_before;  ///< from all answers at once
  training::GroupEstimate group_after;
  training::GroupChange change;
  // Over repeats with people drawn again: how often 95 % intervals of the mean hold it.
  double covered_by_groups = 0.0;
  double covered_by_medians = 0.0;
};

struct TrainingMeasurement {
  TrainingPlan plan;
  std::vector<double> truths{};      ///< in the main table
  std::vector<MethodRow> methods{};  ///< marginal psi first, 2-down-1-up second
  std::vector<ReadingRow> readings{};
  std::vector<NamedCells> robust{};      ///< marginal psi, then 2-down-1-up
  std::vector<NamedCells> stop_rules{};  ///< half widths
  NamedCells two_intervals{};            ///< 200 trials
  std::vector<ExplorationRow> exploration{};
  std::vector<ExamRow> exam{};
  std::vector<PowerRow> power{};
  std::vector<LearningRow> learning{};
  double band_coverage = 0.0;  ///< share of the truths that the 95 % bands of fits hold
  std::vector<ChangeRow> changes{};
  LearningExample learner{};
  WorkedExample example{};
  double next_level_us_p50 = 0.0;  ///< processor time
  double next_level_us_p99 = 0.0;
};

/// The same for any number of threads, but for the times.
TrainingMeasurement measureTraining(const TrainingPlan& plan, const Progress& progress);

/// Summarises one cell, by the reported summaries of its runs.
RecoveryCell summariseCell(double truth, const std::vector<training::ThresholdSummary>& reported,
                           const std::vector<double>& trials = {});

/// Findings of simulated trainees' tests, in sentences whose verdicts their numbers decide.
std::vector<std::string> trainingFindings(const TrainingMeasurement& found);

/// `palpate study training`: whether tests of palpation give back the thresholds of simulated trainees.
Study trainingStudy();

}  // namespace palpate::study
